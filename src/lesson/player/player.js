
  // ---- words, keys, colours: of every page that goes through steps and frames -----------------------------------------

  function speak() {
    document.documentElement.lang = data.tags[lang];
    document.title = $("title").textContent = pick(data.title);
    $("language").textContent = words().language;
    for (const e of document.querySelectorAll("[data-word]")) e.textContent = words()[e.dataset.word];
    for (const e of document.querySelectorAll("[data-title]")) e.title = words()[e.dataset.title];
    for (const e of document.querySelectorAll("[data-label]")) e.setAttribute("aria-label", words()[e.dataset.label]);
    spoken();
  }
  $("language").addEventListener("click", () => {
    lang = lang === "en" ? "zh" : "en";
    speak();
  });
  const theme = () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  };
  $("theme").addEventListener("click", theme);
  // Without a construction there are no steps.
  if ($("first")) {
    $("first").addEventListener("click", () => go(1));
    $("previous").addEventListener("click", () => go(step - 1));
    $("next").addEventListener("click", () => go(step + 1));
    $("last").addEventListener("click", () => {
      stepping = false;
      step = steps().length;
      showStep();
      note();
    });
  }
  // The drawings of a step, for the sheets and the speaker: those to which it adds something, else those of the step before.
  let seen = [];
  function drawingsNow() {
    const all = [...document.querySelectorAll(".drawing svg")].filter((svg) => svg.querySelector("[data-step]"));
    const now = all.filter((svg) => svg.querySelector(".now"));
    return (seen = now.length ? now : seen.length ? seen : all.slice(0, 1));
  }
  const sentence = (k) => `<p>${pick(steps()[k - 1])}</p>`;
  function stage(k) {
    go(k);
    return { pictures: drawingsNow(), html: sentence(k) };
  }
  const noted = () => ({ pictures: drawingsNow(), html: step ? sentence(step) : "", next: step < steps().length ? sentence(step + 1) : "" });
  const tellNext = () => words().coming;
  const answersNow = () => $("answers").innerHTML;

  let kept = null;
  addEventListener("beforeprint", () => {
    play(false);
    kept = step;
    sheets(steps().length);
    step = steps().length;
    stepping = false;
    showStep();
  });
  addEventListener("afterprint", () => {
    $("all").replaceChildren();
    stepping = true;
    step = kept;
    showStep();
  });
  $("print").addEventListener("click", () => print());
  $("speaker").addEventListener("click", speaker);
  const keys = {
    ArrowRight: () => go(step + 1),
    PageDown: () => go(step + 1),
    ArrowLeft: () => go(step - 1),
    PageUp: () => go(step - 1),
    Home: () => go(1),
    End: () => go(steps().length),
    "+": () => toFrame(frame + 1),
    "-": () => toFrame(frame - 1),
    " ": () => play(!running && !still.matches),
    l: () => $("language").click(),
    d: theme,
    p: () => print(),
    s: speaker,
    ...ownKeys,
  };
  addEventListener("keydown", (e) => {
    const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
    if (e.ctrlKey || e.altKey || e.metaKey || e.target.tagName === "INPUT" || !keys[key]) return;
    keys[key]();
    e.preventDefault();
  });

  speak();
  document.documentElement.dataset.ready = "";
})();
