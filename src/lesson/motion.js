"use strict";
// The page of a motion at work: shows the construction step by step at an instant, and moves that. What each instant draws stands in the
// page as it was drawn by the library.
(async () => {
  const pressed = Uint8Array.from(atob(document.getElementById("data").textContent), (c) => c.charCodeAt(0));
  const opened = new Blob([pressed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const data = JSON.parse(await new Response(opened).text());
  const $ = (id) => document.getElementById(id);
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let lang = data.lang;
  let frame = data.given;
  let step = data.frames[frame].steps.length;
  let stepping = false;
  let sense = 1;
  let running = 0;

  const words = () => data.words[lang];
  const pick = (both) => both[lang === "en" ? 0 : 1];
  const figures = data.drawings.map((_, k) => $(`drawing-${k}`));
  const steps = () => data.frames[frame].steps;

  // ---- steps ------------------------------------------------------------------------------------------------------

  function showStep() {
    for (const g of document.querySelectorAll(".moving [data-step]")) {
      const k = Number(g.dataset.step);
      g.classList.toggle("later", k >= step);
      g.classList.toggle("now", k === step - 1 && stepping);
    }
    $("count").textContent = words().step.replace("{}", step).replace("{}", steps().length);
    $("sentence").innerHTML = step > 0 ? pick(steps()[step - 1]) : "";
    $("first").disabled = $("previous").disabled = step <= 1;
    $("next").disabled = $("last").disabled = step >= steps().length;
  }
  function go(to) {
    stepping = true;
    step = Math.max(1, Math.min(steps().length, to));
    showStep();
  }

  // ---- the instant ------------------------------------------------------------------------------------------------

  function showFrame() {
    const f = data.frames[frame];
    figures.forEach((e, k) => {
      e.querySelector(".moving").innerHTML = data.drawings[k][frame];
      e.querySelector(".scale").innerHTML = f.scales[k];
    });
    $("travel").textContent = `${f.at}${frame === data.given ? ` (${words().given})` : ""}`;
    $("time").value = frame;
    $("answers").innerHTML = pick(f.answers);
    showStep();
  }
  function toFrame(k) {
    frame = Math.max(0, Math.min(data.frames.length - 1, k));
    showFrame();
  }
  function run(time) {
    if (!running) return;
    if (time - running > 60) {
      running = time;
      if (frame + sense < 0 || frame + sense >= data.frames.length) sense = -sense;
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

  // ---- what the player needs --------------------------------------------------------------------------------------

  const spoken = () => {
    figures.forEach((e, k) => {
      e.querySelector(".caption").innerHTML = pick(data.captions[k]);
      e.querySelector("svg").setAttribute("aria-label", e.querySelector(".caption").textContent);
    });
    $("time").setAttribute("aria-label", words().instant);
    showFrame();
  };
  const ownKeys = { 0: home };
