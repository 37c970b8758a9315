"use strict";
// The page at work: decodes the frames, moves the drawings, tells the steps. It draws nothing anew: every element stands in
// the page, and only its numbers and whether it is seen change.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const TURN = 2 * Math.PI * (data.turns || 1);
  const times = data.travel;
  const count = times.length;
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  // ---- numbers ----------------------------------------------------------------------------------------------------

  /** Reads packed columns one after the other; `earlier` keeps those read before. See pack.rs. */
  function reader(text, earlier = []) {
    const half = data.digits.length / 2;
    let at = 0;
    const natural = () => {
      for (let n = 0, power = 1; ; power *= half) {
        const d = data.digits.indexOf(text[at++]);
        n += (d % half) * power;
        if (d < half) return n;
      }
    };
    return (length) => {
      const order = natural();
      if (order === 4) return earlier[natural()];
      const v = [];
      earlier.push(v);
      for (let k = 0; k < length; k++) {
        const z = natural();
        const off = z % 2 ? -(z + 1) / 2 : z / 2;
        const told = [0, v[k - 1], 2 * v[k - 1] - v[k - 2], 3 * v[k - 1] - 3 * v[k - 2] + v[k - 3]][Math.min(order, k)];
        v.push(told + off);
      }
      return v;
    };
  }

  /** Runs (seen, not seen, seen …) as one flag a frame. */
  function flags(runs) {
    if (!runs.length) return new Array(count).fill(true);
    return runs.flatMap((n, i) => new Array(n).fill(i % 2 === 0));
  }

  /** Runs of (value, length) as one value a frame. */
  function stretched(runs) {
    const list = [];
    for (let i = 0; i < runs.length; i += 2) list.push(...new Array(runs[i + 1]).fill(runs[i]));
    return list;
  }

  /** A column of the frames in which something is seen, spread over all frames. */
  function spread(values, seen) {
    let i = 0;
    return seen.map((s) => (s ? values[i++] / data.unit : NaN));
  }

  /** The frame before or after, round the turn where it is closed. */
  const frame = (k) => (data.full ? ((k % count) + count) % count : k);
  const time = (k) => (data.full ? times[frame(k)] + TURN * Math.floor(k / count) : times[k]);
  const inside = (k) => data.full || (k >= 0 && k < count);

  /** Where a travel lies: between which frames, and how far (0 to 1). */
  function locate(t) {
    let lo = 0;
    let hi = count - (data.full ? 0 : 1);
    while (hi - lo > 1) {
      const mid = (lo + hi) >> 1;
      if (times[mid] <= t) lo = mid;
      else hi = mid;
    }
    const s = count > 1 ? (t - time(lo)) / (time(lo + 1) - time(lo)) : 0;
    return { k: lo, s: Math.min(Math.max(s, 0), 1) };
  }

  /** The frame nearest to a place. */
  const near = ({ k, s }) => (s < 0.5 || !inside(k + 1) ? k : frame(k + 1));

  /** Beyond the last frame in which something is seen: on by the parabola through the last three. */
  function onward(column, known, from, sense, t) {
    const last = [];
    for (let i = from; last.length < 3 && known(i); i += sense) last.push(i);
    const weight = (i) => last.reduce((w, j) => (i === j ? w : (w * (t - time(j))) / (time(i) - time(j))), 1);
    return last.reduce((sum, i) => sum + column[frame(i)] * weight(i), 0);
  }

  /** The value of a column at a place: the curve of curve.rs, or a straight line for labels. With `scales` (one a frame) only frames
      to the scale of the nearest one tell anything. */
  function value(column, where, straight, scales) {
    const { k, s } = where;
    if (s === 0 || s === 1) return column[frame(k + s)];
    const scale = scales && scales[near(where)];
    const known = (i) => inside(i) && !Number.isNaN(column[frame(i)]) && (!scales || scales[frame(i)] === scale);
    if (!known(k) || !known(k + 1)) {
      const [from, sense] = known(k) ? [k, -1] : [k + 1, 1];
      return straight ? column[frame(from)] : onward(column, known, from, sense, time(k) + s * (time(k + 1) - time(k)));
    }
    const [p0, p1] = [column[frame(k)], column[frame(k + 1)]];
    if (straight) return p0 + (p1 - p0) * s;
    const step = (i) => time(i + 1) - time(i);
    const rise = (i) => (column[frame(i + 1)] - column[frame(i)]) / step(i);
    const weigh = (a, b) => (step(b) * rise(a) + step(a) * rise(b)) / (step(a) + step(b));
    const before = known(k - 1);
    const after = known(k + 2);
    const here = rise(k);
    const m0 = before ? weigh(k - 1, k) : after ? 2 * here - weigh(k, k + 1) : here;
    const m1 = after ? weigh(k, k + 1) : before ? 2 * here - weigh(k - 1, k) : here;
    const h = step(k);
    const s2 = s * s;
    const s3 = s2 * s;
    return p0 * (2 * s3 - 3 * s2 + 1) + m0 * h * (s3 - 2 * s2 + s) + p1 * (3 * s2 - 2 * s3) + m1 * h * (s3 - s2);
  }

  // ---- drawings ---------------------------------------------------------------------------------------------------

  /** An attribute's value as text and numbers in turn; flags of arcs are text. */
  function pieces(text) {
    const parts = [""];
    let command = "";
    let since = 0;
    for (const token of text.match(/-?\d[\d.]*|[^-\d]/g)) {
      const number = /\d/.test(token[token.length - 1]);
      if (number && !(command === "A" && since >= 2 && since < 5)) parts.push(token, "");
      else parts[parts.length - 1] += token;
      if (number) since++;
      else if (/[A-Za-z]/.test(token)) [command, since] = [token, 0];
    }
    return parts;
  }

  const rounded = (mm) => Math.round(mm * 1000) / 1000;

  /** Moves an arrow by its ends; shaft and head as in arrow.rs. */
  function arrow(element, ends, [length, width, notch, most], scales) {
    const [line, head] = element.children;
    return (where) => {
      const [x1, y1, x2, y2] = ends.map((values) => value(values, where, false, scales));
      const far = Math.hypot(x2 - x1, y2 - y1) || 1;
      const [ux, uy] = [(x2 - x1) / far, (y2 - y1) / far];
      const k = Math.min((most * far) / length, 1);
      const [back, side] = [length * k, (width * Math.sqrt(k)) / 2];
      const at = (t, s) => [x2 - ux * t + uy * s, y2 - uy * t - ux * s].map(rounded);
      const notched = at(back * (1 - notch), 0);
      ["x1", "y1", "x2", "y2"].forEach((name, i) => line.setAttribute(name, rounded([x1, y1, ...notched][i])));
      const corners = [at(0, 0), at(back, side), notched, at(back, -side)];
      head.setAttribute("d", `M${corners.map((c) => c.join(" ")).join("L")}Z`);
    };
  }

  const drawings = data.drawings.map(({ key, moving, shown, scales: told }) => {
    const figure = $(key);
    const ink = figure.querySelector(".ink");
    const elements = [...ink.children];
    const earlier = [];
    const scales = told && { list: told[0], which: stretched(told[1]), now: -1 };
    const movers = moving.map(([index, runs, places, packed]) => {
      const element = elements[index];
      const seen = flags(runs);
      const read = reader(packed, earlier);
      const length = seen.filter(Boolean).length;
      const attributes = places.map((place) => {
        const [part, name, ...numerals] = place.split(" ");
        if (name === "arrow") {
          const ends = [1, 2, 3, 4].map(() => spread(read(length), seen));
          return arrow(element, ends, numerals.map(Number), scales && scales.which);
        }
        const target = part === "0" ? element : element.querySelectorAll("*")[part - 1];
        const parts = pieces(target.getAttribute(name));
        const columns = numerals.map((n) => ({ at: 2 * n + 1, values: spread(read(length), seen) }));
        const straight = name === "transform";
        return (where) => {
          for (const { at, values } of columns) parts[at] = rounded(value(values, where, straight, scales && scales.which));
          target.setAttribute(name, parts.join(""));
        };
      });
      return { element, seen, attributes };
    });
    const stepped = elements.map((element) => {
      const words = element.getAttribute("class").split(" ");
      const steps = words.filter((w) => w.startsWith("step-")).map((w) => Number(w.slice(5)));
      return { element, step: steps.length ? Math.min(...steps) : -1 };
    });
    return { key, figure, ink, movers, stepped, scales, shown: flags(shown), off: figure.querySelector(".off") };
  });

  /** Says to which of its scales a drawing is drawn. */
  function rescale({ figure, scales }, k) {
    if (!scales || scales.which[k] === scales.now) return;
    scales.now = scales.which[k];
    const [mu, formula] = scales.list[scales.now];
    figure.querySelector("svg").dataset.mu = mu;
    figure.querySelector(".scale").innerHTML = formulaList[formula];
    figure.classList.toggle("rescaled", scales.now > 0);
  }

  function move(where) {
    const nearest = near(where);
    for (const d of drawings) {
      const on = d.shown[nearest];
      d.ink.style.display = on ? "" : "none";
      d.off.hidden = on;
      rescale(d, nearest);
      if (!on) continue;
      for (const { element, seen, attributes } of d.movers) {
        const visible = seen[nearest];
        if (visible !== (element.getAttribute("display") !== "none")) {
          if (visible) element.removeAttribute("display");
          else element.setAttribute("display", "none");
        }
        if (!visible) continue;
        for (const draw of attributes) draw(where);
      }
    }
  }

  // ---- words ------------------------------------------------------------------------------------------------------

  let lang = data.lang;
  const other = { en: "zh", zh: "en" };
  const word = (key, ...fills) => fills.reduce((text, f) => text.replace("{}", f), data.words[lang][key]);
  const which = () => (lang === "en" ? 0 : 1);

  /** Tags in the place of their signs; see bank.rs. */
  const tagged = (text) => text.replace(/[\uE010-\uE02F]/g, (c) => data.tags[c.charCodeAt(0) - 0xe010]);
  const formulaList = data.formulas.map(tagged);

  /** Formulas in the place of their indices. */
  const formulas = (text) => tagged(text).replace(/\uE001(\d+)\uE002/g, (_, n) => formulaList[n]);

  /** A sentence of a frame; see bank.rs. */
  function sayer([en, zh]) {
    const open = (told, numbers) => {
      const [written, sequence] = told;
      const forms = written.map(formulas);
      const holes = forms.map((f) => f.split("\uE000").length - 1);
      const list = numbers === "" ? [] : numbers.split(" ");
      const frames = [];
      let next = 0;
      for (const form of stretched(sequence === 0 ? [0, count] : sequence)) {
        frames.push(form < 0 ? null : [form, next]);
        if (form >= 0) next += holes[form];
      }
      return (k) => {
        if (!frames[k]) return "";
        let [form, at] = frames[k];
        return forms[form].split("\uE000").reduce((text, piece) => text + list[at++] + piece);
      };
    };
    const says = { en: open(en, en[2]), zh: open(zh, zh[2] === 0 ? en[2] : zh[2]) };
    return (k) => says[lang](k);
  }

  const steps = data.steps.map(([key, n, en, zh]) => ({ key, n, say: sayer([en, zh]) }));
  const equations = data.equations;
  const variants = stretched(equations.frames === 0 ? [0, count] : equations.frames);

  /** The equation that a step of a frame solves, what the step draws of it marked; see equations.rs. */
  function equation(of, k) {
    const told = of && variants[k] >= 0 ? equations.variants[variants[k]][of.key === "acceleration" ? 1 : 0] : [];
    if (!told[of?.n]) return { index: -1, html: "" };
    const [index, ...now] = told[of.n];
    const columns = equations.written[index];
    if (columns.line) return { index, html: `<p>${formulas(columns.line[which()])}</p>` };
    const later = told.slice(of.n + 1).flatMap((t) => (t && t[0] === index ? t.slice(1) : []));
    const face = (c) => (now.includes(c) ? "now" : later.includes(c) ? "later" : "");
    const [magnitude, direction] = data.rows[which()];
    const [second, third] = [[magnitude, 3], [direction, 2]][equations.direction_first ? "reverse" : "slice"]();
    const row = ([head, part]) => {
      const cell = (n, c) => `<td class="${face(c)}">${n < 0 ? "" : formulaList[n]}</td>`;
      const sign = (n) => `<td>${n < 0 || part > 1 ? "" : formulaList[n]}</td>`;
      return `<tr><th scope="row">${head}</th>${columns.map((c, i) => (i ? sign(c[0]) : "") + cell(c[part], i)).join("")}</tr>`;
    };
    return { index, html: `<table class="equation">${[["", 1], second, third].map(row).join("")}</table>` };
  }

  const answers = data.answers.map((a) => sayer(a));
  const answerItems = answers.map(() => $("answers").appendChild(document.createElement("li")));

  // ---- state ------------------------------------------------------------------------------------------------------

  let travel = times[data.base];
  let step = steps.length;
  let begun = false;
  let running = 0;

  const ends = () => [times[0], times[count - 1]];
  const start = data.driver.start === null ? 0 : data.driver.start;

  const [wholeTurn, fineness] = [data.driver.turn || 360, data.driver.parts || 10];

  function shownValue(t) {
    let v = start + t * data.driver.factor;
    if (data.driver.turns) v = ((v % wholeTurn) + wholeTurn) % wholeTurn;
    const digits = Math.round(v * fineness) / fineness;
    const text = String(data.driver.turns && digits === wholeTurn ? 0 : digits).replace("-", "−");
    return text + (data.driver.unit || (data.driver.turns ? "°" : " mm"));
  }

  const label = (t) => `${data.driver.symbol} = ${shownValue(t)}`;

  /** Where the driver is at the end of its way, and which end. */
  function atLimit() {
    if (data.full) return -1;
    const [low, high] = ends();
    const close = 1e-9 * (high - low);
    if (data.limits[0] && travel <= low + close) return 0;
    if (data.limits[1] && travel >= high - close) return 1;
    return -1;
  }

  let told = -1;
  let toldLimit = null;
  let written = "";

  function show() {
    const where = locate(travel);
    move(where);
    placeGrip(where);
    const k = near(where);
    $("travel").innerHTML = label(travel);
    if (k !== told) {
      told = k;
      tell();
    }
    const limit = atLimit();
    if (limit !== toldLimit) {
      toldLimit = limit;
      $("limit").textContent = limit < 0 ? "" : data.limits[limit][which()];
    }
  }

  /** What is said of the nearest frame: the numbers hold for its position, which stands beside them. */
  function tell() {
    $("at").innerHTML = `(${label(times[told])})`;
    answers.forEach((say, i) => (answerItems[i].innerHTML = say(told)));
    $("sentence").innerHTML = !begun ? word("finished") : step ? steps[step - 1].say(told) : formulas(data.statement[which()]);
    const { html } = equation(begun && step > 0 ? steps[step - 1] : null, told);
    if (html !== written) $("equation").innerHTML = written = html;
    $("count").textContent = word("step", step, steps.length);
  }

  function reveal() {
    for (const d of drawings) {
      if (d.key === "mechanism") continue;
      const first = steps.findIndex((s) => s.key === d.key);
      for (const { element, step: n } of d.stepped) {
        const of = first + n + 2;
        element.classList.toggle("later", of > step);
        element.classList.toggle("now", begun && of === step);
      }
    }
    $("first").disabled = $("previous").disabled = begun && step === 0;
    $("last").disabled = $("next").disabled = step === steps.length;
  }

  function go(to) {
    begun = true;
    step = Math.min(Math.max(to, 0), steps.length);
    reveal();
    tell();
  }

  function turn(t) {
    if (data.full) travel = times[0] + (((t - times[0]) % TURN) + TURN) % TURN;
    else travel = Math.min(Math.max(t, ends()[0]), ends()[1]);
    show();
  }

  // ---- the grip ---------------------------------------------------------------------------------------------------

  const svg = document.querySelector("#mechanism svg");
  const gripAt = (() => {
    const read = reader(data.handle);
    const [x, y] = [read(count), read(count)].map((v) => v.map((n) => n / data.unit));
    return (where) => [value(x, where), value(y, where)];
  })();
  const grip = document.createElementNS(svg.namespaceURI, "g");
  grip.setAttribute("class", "grip");
  grip.setAttribute("role", "slider");
  grip.setAttribute("tabindex", "0");
  for (const [name, r] of [["reach", 8], ["ring", 3.6]]) {
    const circle = document.createElementNS(svg.namespaceURI, "circle");
    circle.setAttribute("class", name);
    circle.setAttribute("r", r);
    grip.append(circle);
  }
  // Below the drawing, so that it hides no letter; the drawing lets the pointer through.
  svg.prepend(grip);

  function placeGrip(where) {
    const [x, y] = gripAt(where);
    grip.setAttribute("transform", `translate(${Math.round(x * 1000) / 1000} ${Math.round(y * 1000) / 1000})`);
    const shown = start + travel * data.driver.factor;
    grip.dataset.travel = travel;
    grip.setAttribute("aria-valuenow", Math.round(shown * 10) / 10);
    grip.setAttribute("aria-valuetext", `${data.driver.plain} = ${shownValue(travel)}`);
  }

  /** The travel at which the grip is nearest to a point; not far from where it is, where the way has ends. */
  function travelAt([x, y]) {
    const off = (t) => {
      const [gx, gy] = gripAt(locate(t));
      return (gx - x) ** 2 + (gy - y) ** 2;
    };
    const here = locate(travel).k;
    const reach = Math.ceil(data.full ? count / 2 : count / 4);
    let best = here;
    let least = Infinity;
    for (let k = here - reach; k <= here + reach; k++) {
      if (!inside(k)) continue;
      const [gx, gy] = gripAt({ k: frame(k), s: 0 });
      const d = (gx - x) ** 2 + (gy - y) ** 2;
      if (d < least) [least, best] = [d, k];
    }
    let [lo, hi] = [inside(best - 1) ? time(best - 1) : time(best), inside(best + 1) ? time(best + 1) : time(best)];
    const wrapped = (t) => (data.full ? times[0] + (((t - times[0]) % TURN) + TURN) % TURN : t);
    for (let i = 0; i < 50; i++) {
      const [a, b] = [lo + (hi - lo) * 0.382, lo + (hi - lo) * 0.618];
      if (off(wrapped(a)) < off(wrapped(b))) hi = b;
      else lo = a;
    }
    // At an end of the way the end itself is meant.
    const found = (lo + hi) / 2;
    if (!data.full) for (const end of ends()) if (off(end) <= off(found)) return end;
    return found;
  }

  const point = (event) => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [p.x, p.y];
  };
  let held = null;
  grip.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stop();
    const [px, py] = point(event);
    const [gx, gy] = gripAt(locate(travel));
    held = { id: event.pointerId, off: [gx - px, gy - py] };
    grip.setPointerCapture(event.pointerId);
    grip.classList.add("held");
    grip.focus({ preventScroll: true });
    event.preventDefault();
  });
  grip.addEventListener("pointermove", (event) => {
    if (!held || event.pointerId !== held.id) return;
    const [px, py] = point(event);
    turn(travelAt([px + held.off[0], py + held.off[1]]));
  });
  for (const name of ["pointerup", "pointercancel"]) {
    grip.addEventListener(name, (event) => {
      if (!held || event.pointerId !== held.id) return;
      held = null;
      grip.classList.remove("held");
      settle();
    });
  }

  // ---- motion -----------------------------------------------------------------------------------------------------

  /** Let go, the driver comes to rest in the nearest position of which the numbers are known. */
  function settle() {
    const where = locate(travel);
    const target = time(where.s < 0.5 || !inside(where.k + 1) ? where.k : where.k + 1);
    const from = travel;
    if (still.matches || from === target) return turn(target);
    const begin = performance.now();
    const run = (now) => {
      const s = Math.min((now - begin) / 120, 1);
      turn(s < 1 ? from + (target - from) * s : target);
      running = s < 1 ? requestAnimationFrame(run) : 0;
    };
    running = requestAnimationFrame(run);
  }

  let playing = false;
  let sense = data.driver.back ? -1 : 1;
  const ROUND_MS = 9000;

  function stop() {
    cancelAnimationFrame(running);
    clearTimeout(running);
    running = 0;
    if (playing) {
      playing = false;
      face();
    }
  }

  function play() {
    if (playing) {
      stop();
      return settle();
    }
    stop();
    playing = true;
    face();
    const span = data.full ? TURN : ends()[1] - ends()[0];
    if (still.matches) {
      const hop = () => {
        by(sense);
        if (!data.full && (travel === ends()[0] || travel === ends()[1])) sense = travel === ends()[0] ? 1 : -1;
        running = setTimeout(hop, 700);
      };
      return hop();
    }
    let last = performance.now();
    const run = (now) => {
      turn(travel + (sense * span * Math.min(now - last, 100)) / ROUND_MS);
      last = now;
      const end = !data.full && (travel === ends()[0] || travel === ends()[1]);
      if (end) {
        // Stands a moment, so that it is read why, and goes back.
        sense = travel === ends()[0] ? 1 : -1;
        running = setTimeout(() => {
          last = performance.now();
          running = requestAnimationFrame(run);
        }, 1500);
      } else running = requestAnimationFrame(run);
    };
    running = requestAnimationFrame(run);
  }

  /** So many frames on. */
  function by(n) {
    const { k, s } = locate(travel);
    const from = s < 0.5 || !inside(k + 1) ? k : k + 1;
    const to = data.full ? from + n : Math.min(Math.max(from + n, 0), count - 1);
    turn(time(to));
  }

  function home() {
    stop();
    turn(times[data.base]);
  }

  // ---- the page ---------------------------------------------------------------------------------------------------

  function face() {
    const key = playing ? "pause" : data.driver.turns ? "play" : "slide";
    $("play").querySelector("span").textContent = word(key);
    $("play").setAttribute("aria-pressed", playing);
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
    $("hint").textContent = word(data.driver.turns ? "drag" : "drag_slide");
    $("notes").textContent = `${word(`scales${drawings.some((d) => d.scales) ? "_steps" : ""}${data.cut ? "_cut" : ""}`)} ${word("rates")}`;
    for (const d of drawings) d.off.textContent = d.key === "mechanism" ? "" : word(`off_${d.key}`);
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

  /** All drawings as large as they fit side by side with the words below the polygons. */
  function fit() {
    const sizes = drawings.map((d) => d.figure.querySelector("svg").viewBox.baseVal);
    const [first, ...rest] = sizes;
    const em = parseFloat(getComputedStyle(document.body).fontSize);
    const wide = document.querySelector("main").clientWidth - 32 - 14 * sizes.length;
    const high = innerHeight - $("left").getBoundingClientRect().top - scrollY - 2.5 * em;
    const width = sizes.reduce((sum, s) => sum + s.width, 0);
    const rooms = sizes.map((_, i) => (i ? 0.52 : 1) * high);
    const k = Math.max(1.5, Math.min(wide / width, ...sizes.map((s, i) => rooms[i] / s.height)));
    // What is left of the width makes those larger that have room above the words.
    let left = Math.max(0, wide - k * width);
    sizes.forEach((s, i) => {
      const own = Math.max(k, Math.min(2 * k, rooms[i] / s.height, k + left / s.width));
      left -= (own - k) * s.width;
      drawings[i].figure.style.setProperty("--k", own);
    });
    // On paper, A4 upright: the polygons beside one another below the mechanism.
    const below = rest.reduce((sum, s) => sum + s.width, 0);
    document.body.style.setProperty("--m", Math.min(1, 178 / Math.max(first.width, below), 110 / first.height));
  }

  $("first").addEventListener("click", () => go(0));
  $("previous").addEventListener("click", () => go(step - 1));
  $("next").addEventListener("click", () => go(step + 1));
  $("last").addEventListener("click", () => go(steps.length));
  $("play").addEventListener("click", play);
  $("home").addEventListener("click", home);
  $("theme").addEventListener("click", theme);
  $("print").addEventListener("click", () => print());
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
    const inButton = event.target.closest && event.target.closest("button, summary");
    const keys = {
      ArrowRight: () => go(step + 1),
      PageDown: () => go(step + 1),
      ArrowLeft: () => go(step - 1),
      PageUp: () => go(step - 1),
      Home: () => go(0),
      End: () => go(steps.length),
      "+": () => (stop(), by(event.shiftKey ? 6 : 1)),
      "=": () => (stop(), by(1)),
      "-": () => (stop(), by(-1)),
      _: () => (stop(), by(-6)),
      0: home,
      l: () => $("language").click(),
      d: theme,
      p: () => print(),
    };
    const act = event.key === " " && !inButton ? play : keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    act();
    event.preventDefault();
  });
  addEventListener("resize", fit);

  // On paper: the given position, all steps drawn, and all sentences below.
  let kept = null;
  addEventListener("beforeprint", () => {
    stop();
    kept = { travel, step, begun };
    turn(times[data.base]);
    go(steps.length);
    begun = false;
    reveal();
    let last = -1;
    $("all").replaceChildren(
      ...steps.map((s) => {
        const item = document.createElement("li");
        const { index, html } = equation(s, data.base);
        item.innerHTML = (index === last ? "" : html) + s.say(data.base);
        if (index >= 0) last = index;
        return item;
      }),
    );
  });
  addEventListener("afterprint", () => {
    if (!kept) return;
    ({ step, begun } = kept);
    turn(kept.travel);
    reveal();
    tell();
    kept = null;
  });

  fit();
  reveal();
  speak();
})();
