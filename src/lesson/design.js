"use strict";
// The page of a design at work: shows the construction step by step, moves the linkage through its wanted positions. Every line of the
// construction stands in the page; of the linkage the page holds the places of all points in each frame.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const SVG = "http://www.w3.org/2000/svg";
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let lang = data.lang;
  let step = data.steps.length;
  let frame = 0;
  let sense = 1;
  let running = 0;

  const words = () => data.words[lang];
  const pick = (both) => both[lang === "en" ? 0 : 1];
  const steps = () => data.steps;

  // What has no construction has no steps to go through.
  if (!data.steps.length) {
    $("left").remove();
    $("right").style.gridColumn = "1 / -1";
  }

  // ---- the construction -------------------------------------------------------------------------------------------

  const drawn = [...document.querySelectorAll("[data-step]")];
  function showStep() {
    for (const g of drawn) {
      const k = Number(g.dataset.step);
      g.classList.toggle("later", k >= step);
      g.classList.toggle("now", k === step - 1 && step < data.steps.length + 1 && stepping);
    }
    if (!$("count")) return;
    $("count").textContent = words().step.replace("{}", step).replace("{}", data.steps.length);
    $("sentence").innerHTML = step > 0 ? pick(data.steps[step - 1]) : "";
    $("first").disabled = $("previous").disabled = step <= 1;
    $("next").disabled = $("last").disabled = step >= data.steps.length;
  }
  let stepping = false;
  function go(to) {
    stepping = true;
    step = Math.max(1, Math.min(data.steps.length, to));
    showStep();
  }

  // ---- the linkage ------------------------------------------------------------------------------------------------

  const moving = document.querySelector("#linkage .moving");
  const made = (name, attributes) => {
    const e = document.createElementNS(SVG, name);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    moving.append(e);
    return e;
  };
  const links = data.links.map((l) => made(l.length > 2 ? "polygon" : "polyline", {}));
  const blocks = data.blocks.map(() => made("rect", { width: 5, height: 3, x: -2.5, y: -1.5 }));
  const pins = data.pins.map(() => made("circle", { r: 0.9 }));
  const point = (k) => [data.frames[frame].p[2 * k], data.frames[frame].p[2 * k + 1]];
  const stopAt = () => data.stops.indexOf(frame);
  function showFrame() {
    const stop = stopAt();
    links.forEach((e, i) => e.setAttribute("points", data.links[i].map((k) => point(k).join(",")).join(" ")));
    pins.forEach((e, i) => {
      const [x, y] = point(data.pins[i]);
      e.setAttribute("cx", x);
      e.setAttribute("cy", y);
      e.classList.toggle("reached", stop >= 0 && !data.fixed.includes(data.pins[i]));
    });
    blocks.forEach((e, i) => {
      const [x, y] = point(data.blocks[i]);
      e.setAttribute("transform", `translate(${x} ${y}) rotate(${data.frames[frame].r[i]})`);
    });
    $("travel").textContent = `φ = ${data.frames[frame].d}°`;
    $("driver").value = frame;
    [...$("stops").children].forEach((b, k) => b.setAttribute("aria-pressed", String(k === stop)));
  }
  function toFrame(k) {
    const n = data.frames.length;
    frame = data.full ? ((k % n) + n) % n : Math.max(0, Math.min(n - 1, k));
    showFrame();
  }
  function run(time) {
    if (!running) return;
    if (time - running > 40) {
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
  data.stops.forEach((k, i) => {
    const b = document.createElement("button");
    b.type = "button";
    b.textContent = String(i + 1);
    b.addEventListener("click", () => {
      play(false);
      toFrame(k);
    });
    $("stops").append(b);
  });
  $("driver").max = data.frames.length - 1;
  $("driver").addEventListener("input", () => {
    play(false);
    toFrame(Number($("driver").value));
  });
  $("play").addEventListener("click", () => play(!running));

  // ---- what the player needs --------------------------------------------------------------------------------------

  const spoken = () => {
    $("driver").setAttribute("aria-label", words().positions);
    $("facts").innerHTML = pick(data.facts);
    showStep();
  };
  const ownKeys = {};
  data.stops.slice(0, 9).forEach((k, i) => {
    ownKeys[i + 1] = () => {
      play(false);
      toFrame(k);
    };
  });
  toFrame(data.stops.length ? data.stops[0] : 0);
