"use strict";
// The page of a construction at work: shows it step by step in a frame (a pose, an instant), and moves that. What each frame draws stands
// in the page as it was drawn by the library.
(async () => {
  const pressed = Uint8Array.from(atob(document.getElementById("data").textContent), (c) => c.charCodeAt(0));
  const opened = new Blob([pressed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const data = JSON.parse(await new Response(opened).text());
  const $ = (id) => document.getElementById(id);
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let lang = data.lang;
  let frame = data.given;
  let stepping = true;
  let sense = 1;
  let running = 0;

  const words = () => data.words[lang];
  const pick = (both) => both[lang === "en" ? 0 : 1];
  const figures = data.drawings.map((_, k) => $(`drawing-${k}`));
  /** What the frame says, or all frames together. */
  const told = (name) => data.frames[frame][name] ?? data[name];
  const steps = () => told("steps");
  let step = Math.min(1, steps().length);

  // A single frame is not moved.
  if (data.frames.length < 2) for (const e of [$("time"), $("pose").querySelector(".buttons")]) e.hidden = true;
  // Without a construction there are no steps.
  if (!steps().length) {
    $("left").remove();
    $("right").style.gridColumn = "1 / -1";
  }

  // ---- the drawing that is seen: beside the first one the others take turns -------------------------------------------

  const others = figures.filter((e) => e.closest("#right"));
  function present(k) {
    others.forEach((e, i) => {
      e.classList.toggle("aside", i !== k);
      $("tabs").children[i]?.setAttribute("aria-pressed", String(i === k));
    });
  }
  if (others.length > 1) {
    others.forEach((_, i) => {
      const b = document.createElement("button");
      b.type = "button";
      b.addEventListener("click", () => present(i));
      $("tabs").append(b);
    });
  } else $("tabs").hidden = true;
  const tabbed = () => {
    if (others.length > 1) others.forEach((e, i) => ($("tabs").children[i].textContent = pick(data.captions[figures.indexOf(e)])));
  };

  // ---- steps ------------------------------------------------------------------------------------------------------

  function showStep() {
    step = Math.min(step, steps().length);
    for (const g of document.querySelectorAll(".drawing [data-step]")) {
      const k = Number(g.dataset.step);
      g.classList.toggle("later", k >= step);
      g.classList.toggle("now", k === step - 1 && stepping);
    }
    if (!$("count")) return;
    $("count").textContent = words().step.replace("{}", step).replace("{}", steps().length);
    const now = others.findLastIndex((e) => e.querySelector(".now"));
    if (now >= 0) present(now);
    const first = figures.find((e) => !others.includes(e));
    document.body.classList.toggle("beside", now >= 0 && !!first && !first.querySelector(".now"));
    figures.forEach(middle);
    $("sentence").innerHTML = step > 0 ? pick(steps()[step - 1]) : "";
    $("first").disabled = $("previous").disabled = step <= 1;
    $("next").disabled = $("last").disabled = step >= steps().length;
  }
  function go(to) {
    stepping = true;
    step = Math.max(1, Math.min(steps().length, to));
    showStep();
    note();
  }

  // ---- the instant ------------------------------------------------------------------------------------------------

  function showFrame() {
    const f = data.frames[frame];
    figures.forEach((e, k) => {
      if (data.drawings[k].length) e.querySelector(".moving").innerHTML = data.drawings[k][frame];
      e.querySelector("svg").setAttribute("viewBox", data.windows[k][frame] ?? data.windows[k][0]);
      if (f.scales) e.querySelector(".scale").innerHTML = f.scales[k];
    });
    $("travel").innerHTML = `${f.at}${frame === data.given && words().given ? ` (${words().given})` : ""}`;
    $("time").value = frame;
    $("answers").innerHTML = pick(told("answers"));
    [...$("stops").querySelectorAll("button")].forEach((b, k) => b.setAttribute("aria-pressed", String(data.stops[k] === frame)));
    showStep();
  }
  function toFrame(k) {
    const n = data.frames.length;
    frame = data.full ? ((k % n) + n) % n : Math.max(0, Math.min(n - 1, k));
    showFrame();
    note();
  }
  function run(time) {
    if (!running) return;
    if (time - running > 60) {
      running = time;
      if (!data.full && (frame + sense < 0 || frame + sense >= data.frames.length)) sense = -sense;
      toFrame(frame + sense);
    }
    requestAnimationFrame(run);
  }
  function play(on) {
    running = on ? performance.now() : 0;
    $("play").setAttribute("aria-pressed", String(on));
    if (on) requestAnimationFrame(run);
  }
  const home = () => {
    play(false);
    toFrame(data.given);
  };
  $("time").max = data.frames.length - 1;
  $("time").addEventListener("input", () => {
    play(false);
    toFrame(Number($("time").value));
  });
  $("play").addEventListener("click", () => play(!running));
  $("home").addEventListener("click", home);
  const stopAt = (k) => {
    play(false);
    toFrame(k);
  };
  const stops = data.stops || [];
  if (stops.length) $("stops").innerHTML = '<span data-word="positions"></span>';
  stops.forEach((k, i) => {
    const b = document.createElement("button");
    b.type = "button";
    b.textContent = String(i + 1);
    b.addEventListener("click", () => stopAt(k));
    $("stops").append(b);
  });

  // ---- what the player needs --------------------------------------------------------------------------------------

  const spoken = () => {
    figures.forEach((e, k) => {
      e.querySelector(".caption").textContent = pick(data.captions[k]);
      e.querySelector("svg").setAttribute("aria-label", pick(data.captions[k]));
    });
    tabbed();
    $("time").setAttribute("aria-label", words().instant);
    showFrame();
    note();
  };
  present(0);
  const ownKeys = { 0: home };
  stops.slice(0, 9).forEach((k, i) => (ownKeys[i + 1] = () => stopAt(k)));
