  // ---- state ------------------------------------------------------------------------------------------------------

  let travel = times[data.base];
  let step = Math.min(1, steps.length);
  // True on the screen, where the step is told from the others; false on paper.
  let marked = true;
  let predicting = null;
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
  let written = null;

  function show() {
    const where = locate(travel);
    move(where);
    placeGrip(where);
    overlay(where);
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
    const said = step ? steps[step - 1].say(told) : formulas(data.statement[which()]);
    const asked = predicting && predicting.says();
    fitSentence(asked || said);
    const now = marked && step > 0 ? steps[step - 1] : null;
    const of = asked && steps[step] ? equation(steps[step], told, predicting.hides()) : equation(now, told);
    if (of.html !== written) {
      written = of.html;
      fitEquation(of);
    }
    $("count").textContent = step ? word("step", step, steps.length) : word("task");
    note();
  }

  let spoken = null;

  /** The sentence as large as its room lets it be. */
  function fitSentence(html) {
    if (html === spoken) return;
    const box = $("sentence");
    box.innerHTML = spoken = html;
    for (const size of [1, 0.9, 0.8, 0.7, 0.62]) {
      box.style.setProperty("--fit", size);
      if (!boxed() || box.getBoundingClientRect().bottom <= $("told").getBoundingClientRect().bottom) return;
    }
  }

  /** The equation as large as its room lets it be: smaller first, then in several lines. */
  function fitEquation(of) {
    const box = $("equation");
    for (let lines = 1; lines <= Math.min(of.most, 4); lines++) {
      box.innerHTML = lines === 1 ? of.html : of.html_in(lines);
      for (const size of [1, 0.92, 0.84, 0.76]) {
        box.style.setProperty("--fit", size);
        const wide = Math.max(0, ...[...box.children].map((e) => e.scrollWidth));
        const fits = wide <= box.clientWidth && (!boxed() || box.scrollHeight <= box.clientHeight + 1);
        if (fits) return;
      }
    }
  }

  /** Whether the words have a room of fixed height beside the drawings. */
  const boxed = () => getComputedStyle($("told")).overflow === "hidden";

  /** The drawing that is seen: on the small stage one polygon at a time. */
  function present(key) {
    for (const d of polygons) {
      const on = d.key === key;
      d.figure.classList.toggle("aside", !on);
      const tab = $(`tab-${d.key}`);
      if (tab) tab.setAttribute("aria-pressed", on);
    }
    if (presented === key) return;
    presented = key;
    show();
    if (key) legible(drawing(key));
  }

  function reveal() {
    for (const d of polygons) {
      const first = steps.findIndex((s) => s.level === d.level);
      for (const { stepped } of [...d.layouts, ...mechanism.layouts.filter((l) => l.key === d.key)]) {
        for (const { element, step: n } of stepped) {
          const of = first + n + 2;
          element.classList.toggle("later", of > step);
          element.classList.toggle("now", marked && !predicting && of === step);
        }
      }
    }
    $("first").disabled = $("previous").disabled = marked && step === 0;
    $("last").disabled = $("next").disabled = step === steps.length;
    const at = steps[predicting ? Math.min(step, steps.length - 1) : step - 1];
    if (marked && at) present(at.key);
    drawings.forEach((d) => middle(d.figure));
  }

  function go(to) {
    step = Math.min(Math.max(to, 0), steps.length);
    reveal();
    tell();
    overlay(locate(travel));
  }

  function turn(t) {
    if (data.full) travel = times[0] + (((t - times[0]) % TURN) + TURN) % TURN;
    else travel = Math.min(Math.max(t, ends()[0]), ends()[1]);
    show();
  }

  // ---- the grip ---------------------------------------------------------------------------------------------------

  const gripAt = (() => {
    const read = reader(data.handle);
    const [x, y] = [read(count), read(count)].map((v) => v.map((n) => n / data.unit));
    return (where) => inWindow(mechanism, [value(x, where), value(y, where)]);
  })();
  const grip = drawn("g", { class: "grip", role: "slider", tabindex: "0" });
  for (const [name, r] of [["reach", 8], ["ring", 3.6]]) drawn("circle", { class: name, r }, grip);
  // Below the drawing, so that it hides no letter; the drawing lets the pointer through.
  mechanism.svg.prepend(grip);

  function placeGrip(where) {
    const [x, y] = gripAt(where);
    grip.setAttribute("transform", `translate(${rounded(x)} ${rounded(y)})`);
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
      // Of several turns the one in which the hand is.
      if (data.turns > 1 && Math.abs(time(k) - time(here)) > Math.PI) continue;
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

  let held = null;
  grip.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stop();
    const [px, py] = pointed(mechanism, event);
    const [gx, gy] = gripAt(locate(travel));
    held = { id: event.pointerId, off: [gx - px, gy - py] };
    grip.setPointerCapture(event.pointerId);
    grip.classList.add("held");
    grip.focus({ preventScroll: true });
    event.preventDefault();
  });
  grip.addEventListener("pointermove", (event) => {
    if (!held || event.pointerId !== held.id) return;
    const [px, py] = pointed(mechanism, event);
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

  /** The sense in which it plays: 1 on, −1 back, 0 not at all. */
  let playing = 0;
  const ROUND_MS = 9000;
  const speed = () => 2 ** Number($("speed").value);

  function stop() {
    cancelAnimationFrame(running);
    clearTimeout(running);
    running = 0;
    if (playing) {
      playing = 0;
      face();
    }
  }

  /** What has been passed since the motion began, for hodographs that grow. */
  function pass() {
    const k = near(locate(travel));
    if (grown.way[grown.way.length - 1] !== k) grown.way.push(k);
    if (grown.way.length > 2 * count) grown.way.splice(0, count);
  }

  function play(sense) {
    if (playing === sense) {
      stop();
      return settle();
    }
    stop();
    playing = sense;
    grown = { from: near(locate(travel)), way: [] };
    face();
    const span = data.full ? TURN / (data.turns || 1) : ends()[1] - ends()[0];
    const atEnd = () => !data.full && (travel === ends()[0] || travel === ends()[1]);
    // Time does not run back: its motion begins anew.
    const back = () => {
      if (data.driver.time) {
        grown = { from: 0, way: [] };
        return turn(ends()[playing > 0 ? 0 : 1]);
      }
      playing = travel === ends()[0] ? 1 : -1;
      face();
    };
    if (still.matches) {
      const hop = () => {
        by(playing);
        pass();
        if (atEnd()) back();
        running = setTimeout(hop, 700 / speed());
      };
      return hop();
    }
    let last = performance.now();
    const run = (now) => {
      turn(travel + (playing * span * speed() * Math.min(now - last, 100)) / ROUND_MS);
      pass();
      last = now;
      if (atEnd()) {
        // Stands a moment, so that it is read why, and goes back.
        back();
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
    grown = null;
    drawings.forEach((d) => {
      look(d, 0);
      unzoom(d);
    });
    turn(times[data.base]);
  }
