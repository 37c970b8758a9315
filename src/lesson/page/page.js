  // ---- the page ---------------------------------------------------------------------------------------------------

  function face() {
    for (const [id, sense] of [["play", 1], ["back", -1]]) {
      const on = playing === sense;
      $(id).setAttribute("aria-pressed", on);
      $(id).title = word(on ? "pause" : sense > 0 ? (data.driver.turns ? "play" : "slide") : data.driver.turns ? "play_back" : "slide_back");
      $(id).setAttribute("aria-label", $(id).title);
    }
    $("predict").setAttribute("aria-pressed", !!predicting);
    $("laying").hidden = !predicting;
    const open = predicting && predicting.asking();
    document.body.classList.toggle("asking", !!open);
    for (const id of ["less", "more", "clue", "resign"]) $(id).disabled = !open;
    $("check").textContent = word(open ? "check" : "go_on");
    $("check").disabled = predicting && !open && step === steps.length;
  }

  function speak() {
    document.documentElement.lang = lang;
    document.title = $("title").textContent = data.title[which()];
    for (const e of document.querySelectorAll("[data-text]")) {
      if (!e.closest(".ink")) e.textContent = word(e.dataset.text);
    }
    for (const e of document.querySelectorAll("[data-title]")) {
      e.title = word(e.dataset.title);
      e.setAttribute("aria-label", e.title);
    }
    for (const e of document.querySelectorAll("[data-label]")) e.setAttribute("aria-label", word(e.dataset.label));
    for (const e of document.querySelectorAll("figcaption [data-en]")) e.textContent = e.dataset[lang];
    $("language").textContent = word("language");
    $("language").lang = other[lang];
    $("hint").textContent = word(data.driver.time ? "drag_time" : data.driver.turns ? "drag" : "drag_slide");
    const two = polygons.some((d) => d.layouts.length > 1);
    $("notes").textContent = [word(data.cut ? "scales_cut" : "scales"), two ? word("scales_window") : "", word(data.driver.time ? "rates_time" : "rates")].join(" ");
    for (const d of polygons) {
      const tab = $(`tab-${d.key}`);
      // The parts of a split polygon: the first names it.
      tab.textContent = [d.part ? "" : word(`tab_${kindOf(d)}`), d.part === null ? "" : d.part + 1].join(" ").trim();
      tab.title = d.figure.querySelector("[data-en]").dataset[lang];
      tab.setAttribute("aria-label", tab.title);
    }
    for (const d of polygons) d.off.textContent = word(`off_${kindOf(d)}`);
    written = spoken = null;
    grip.setAttribute("aria-label", word("handle"));
    const values = data.full ? [start, start + wholeTurn * (data.turns || 1)] : ends().map((t) => start + t * data.driver.factor);
    grip.setAttribute("aria-valuemin", Math.round(values[0] * 10) / 10);
    grip.setAttribute("aria-valuemax", Math.round(values[1] * 10) / 10);
    toldLimit = null;
    face();
    tell();
    show();
  }

  function theme() {
    const dark = document.documentElement.dataset.theme
      ? document.documentElement.dataset.theme === "dark"
      : matchMedia("(prefers-color-scheme: dark)").matches;
    document.documentElement.dataset.theme = dark ? "light" : "dark";
  }

  /** On paper, A4 upright: the polygons beside one another below the mechanism. On the screen the stages have their sizes by style. */
  function fit() {
    const sizes = drawings.map((d) => d.size);
    const below = Math.min(polygons.length, 2) * Math.max(...sizes.slice(1).map((s) => s[0]), 0);
    document.body.style.setProperty("--m", Math.min(1, 178 / Math.max(sizes[0][0], below), 110 / sizes[0][1]));
    polygons.forEach(legible);
    written = spoken = null;
    if (told >= 0) tell();
  }

  /** On a phone a polygon is so large that its letters are legible; it is moved by hand. Where it is drawn by hand it is seen as a
      whole. */
  function legible(d) {
    const style = d.svg.style;
    style.minWidth = style.minHeight = "";
    if (innerWidth > 600 || d === mechanism || predicting) return;
    const labels = [...seenThrough(d).ink.children].filter((e) => e.classList.contains("label") && e.getAttribute("display") !== "none");
    const heights = labels.map((e) => (e.querySelector("use, path") || e).getBoundingClientRect()).filter((r) => r.height > 0.45 * r.width);
    const least = Math.min(...heights.map((r) => r.height));
    if (least < LEGIBLE_PX) style.minWidth = style.minHeight = `${Math.min(LEGIBLE_PX / least, 2.5) * 100}%`;
    middle(d.figure);
  }
  const LEGIBLE_PX = 11.3;

  /** A panel that a button opens and closes. */
  function panel(button, id, open) {
    const show = open === undefined ? $(id).hidden : open;
    $(id).hidden = !show;
    $(button).setAttribute("aria-expanded", show);
  }

  // The points that are followed, and what is drawn of them.
  const levels = ["velocity", "acceleration"];
  const kindOf = (d) => levels[d.level] || "force";
  const toggles = { path: "s", velocity: "v", acceleration: "a", hodograph: "h" };
  for (const name of Object.keys(toggles)) {
    const able = name === "path" || name === "hodograph" ? drawings.length > 1 || name === "path" : polygons.some((d) => d.level === levels.indexOf(name));
    $(`show-${name}`).disabled = !able;
    $(`show-${name}`).addEventListener("click", () => toggle(name));
  }
  function toggle(name) {
    if ($(`show-${name}`).disabled) return;
    shows[name] = !shows[name];
    $(`show-${name}`).setAttribute("aria-pressed", shows[name]);
    overlay(locate(travel));
  }
  points.forEach((p, i) => {
    if (!p.moves) return;
    const chip = document.createElement("button");
    chip.type = "button";
    chip.innerHTML = formulaList[p.name];
    chip.setAttribute("aria-pressed", followed.has(i));
    chip.addEventListener("click", () => {
      if (!followed.delete(i)) followed.add(i);
      chip.setAttribute("aria-pressed", followed.has(i));
      overlay(locate(travel));
    });
    $("points").append(chip);
  });
  const tabs = polygons.map((d) => {
    const tab = document.createElement("button");
    tab.type = "button";
    tab.id = `tab-${d.key}`;
    tab.classList.toggle("part", d.part > 0);
    tab.addEventListener("click", () => present(d.key));
    $("tabs").append(tab);
    return tab;
  });
  $("tabs").hidden = tabs.length < 2;
  $("tabs").classList.toggle("many", tabs.length > 2);
  /** The next step, or in a prediction its answer. */
  const forward = () => (predicting ? predicting.giveUp() : go(step + 1));
  const backward = () => {
    if (predicting) predict();
    go(step - 1);
  };
  const other_polygon = () => {
    const at = polygons.findIndex((d) => !d.figure.classList.contains("aside"));
    if (polygons.length) present(polygons[(at + 1) % polygons.length].key);
  };

  const leap = (to) => {
    if (predicting) predict();
    go(to);
  };
  $("first").addEventListener("click", () => leap(0));
  $("previous").addEventListener("click", backward);
  $("next").addEventListener("click", forward);
  $("last").addEventListener("click", () => leap(steps.length));
  $("play").addEventListener("click", () => play(1));
  $("back").addEventListener("click", () => play(-1));
  $("predict").addEventListener("click", predict);
  $("check").addEventListener("click", () => predicting?.check());
  $("less").addEventListener("click", (event) => predicting?.nudge(0, -1, event.shiftKey));
  $("more").addEventListener("click", (event) => predicting?.nudge(0, 1, event.shiftKey));
  $("clue").addEventListener("click", () => predicting?.hint());
  $("resign").addEventListener("click", () => predicting?.giveUp());
  $("reveal").addEventListener("click", () => panel("reveal", "results"));
  $("show").addEventListener("click", () => panel("show", "showing"));
  $("home").addEventListener("click", home);
  $("theme").addEventListener("click", theme);
  $("print").addEventListener("click", () => print());
  $("speaker").addEventListener("click", speaker);
  $("language").addEventListener("click", () => {
    lang = other[lang];
    speak();
  });
  grip.addEventListener("keydown", (event) => {
    const n = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 6, PageDown: -6 }[event.key];
    if (!n || event.ctrlKey || event.metaKey || event.altKey) return;
    stop();
    by(event.shiftKey ? 6 * n : n);
    event.preventDefault();
    event.stopPropagation();
  });
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const inButton = event.target.closest && event.target.closest("button, summary, input");
    if (event.target.tagName === "INPUT" && /^(Arrow|Home|End|Page)/.test(event.key)) return;
    const keys = {
      ArrowRight: forward,
      PageDown: forward,
      ArrowLeft: backward,
      PageUp: backward,
      Home: () => leap(0),
      End: () => leap(steps.length),
      Enter: inButton || !predicting ? null : () => predicting.check(),
      q: predict,
      "?": () => predicting?.hint(),
      b: () => play(-1),
      t: other_polygon,
      r: () => panel("reveal", "results"),
      s: speaker,
      c: () => toggle("path"),
      v: () => toggle("velocity"),
      a: () => toggle("acceleration"),
      h: () => toggle("hodograph"),
      ">": () => faster(1),
      "<": () => faster(-1),
      "+": () => (stop(), by(event.shiftKey ? 6 : 1)),
      "=": () => (stop(), by(1)),
      "-": () => (stop(), by(-1)),
      _: () => (stop(), by(-6)),
      0: home,
      l: () => $("language").click(),
      d: theme,
      p: () => print(),
    };
    const acts = event.key === " " && !inButton ? () => play(playing || (data.driver.back ? -1 : 1)) : keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!acts) return;
    acts();
    event.preventDefault();
  });
  const faster = (by) => ($("speed").value = Number($("speed").value) + by);
  addEventListener("resize", fit);

  // What the sheets and the speaker are told of a step.

  const stageOf = (s) => drawings.filter((d) => d.key === s.key).map((d) => d.svg);
  function stage(k) {
    go(k);
    const s = steps[k - 1];
    return { pictures: stageOf(s), html: equation(s, told).html + `<p>${s.say(told)}</p>` };
  }
  function noted() {
    const s = steps[step - 1];
    return {
      pictures: s ? stageOf(s) : [],
      html: s ? equation(s, told).html + `<p>${s.say(told)}</p>` : `<p>${formulas(data.statement[which()])}</p>`,
      next: step < steps.length ? `<p>${steps[step].say(told)}</p>` : "",
    };
  }
  const tellNext = () => word("coming");
  const answersNow = () => answers.map((say) => `<li>${say(told)}</li>`).join("");

  // On paper: the given position, all steps drawn, then a card for each step.
  let kept = null;
  addEventListener("beforeprint", () => {
    stop();
    if (predicting) predict();
    kept = { travel, step, presented, open: !$("results").hidden };
    home();
    panel("reveal", "results", true);
    sheets(steps.length);
    marked = false;
    go(steps.length);
    present(polygons[0]?.key);
  });
  addEventListener("afterprint", () => {
    if (!kept) return;
    step = kept.step;
    marked = true;
    $("all").replaceChildren();
    panel("reveal", "results", kept.open);
    turn(kept.travel);
    present(kept.presented);
    reveal();
    tell();
    kept = null;
  });

  drawings.forEach((d) => look(d, 0));
  present(polygons[0]?.key);
  fit();
  reveal();
  speak();
  document.documentElement.dataset.ready = "";
})();
