
  // ---- predict, then reveal ---------------------------------------------------------------------------------------
  // The student lays off the next vector before it is shown: its direction, then its length; of two lines the crossing. What is
  // laid off is judged as a pencil's drawing is, and a wrong one is told what is wrong with it.

  /** How far a mark may lie from its place (mm of paper): a pencil's error at either end, and never less than a hand can point at. */
  const POINTED_PX = 5;
  /** A direction is right within this (degrees): what set squares and eye keep to. */
  const TURNED = 1.5;
  /** Near a set square's direction the ray lies along it (degrees). */
  const SNAP = 4;
  const STEP_MM = 0.5;

  const degrees = (v) => (Math.atan2(-v[1], v[0]) * 180) / Math.PI;
  const unit = (a) => [Math.cos((a * Math.PI) / 180), -Math.sin((a * Math.PI) / 180)];
  /** An angle from −180° to 180°. */
  const within = (a) => ((((a + 180) % 360) + 360) % 360) - 180;

  function predictor() {
    let task = null;
    let said = "";
    let right = 0;
    let asked = 0;
    let helped = 0;
    let given = 0;
    let tries = 0;
    let clues = 0;
    const tip = drawn("g", { class: "tip", role: "slider", tabindex: "0" });
    for (const [name, r] of [["reach", 7], ["ring", 2.2]]) drawn("circle", { class: name, r }, tip);

    /** What is asked at a step; null where nothing is laid off. */
    function taskOf(at) {
      const of = steps[at];
      const k = near(locate(travel));
      const about = of && act(of, k);
      const d = of && drawing(of.key);
      if (!about || !d || !d.shown[k] || !["l", "d", "x"].includes(about.kind)) return null;
      const large = seenThrough(d).times;
      if (about.kind === "x") {
        const target = crossingOf(d, about, of, k);
        if (!target) return null;
        const pole = inWindow(d, [0, 0]);
        return { at, d, about, kind: "x", phase: "place", target, guess: [...pole], large };
      }
      for (const e of added(d, of.n)) {
        const isLine = e.tagName === "line" && e.classList.contains("construction");
        if (about.kind === "d" ? !isLine : e.tagName !== "g" || e.classList.contains("label")) continue;
        const ends = isLine ? [["x1", "y1"], ["x2", "y2"]].map((names) => names.map((a) => Number(e.getAttribute(a)))) : endsOf(e);
        if (!ends) continue;
        const by = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        const far = Math.hypot(...by);
        if (far < 0.5) continue;
        const [tail, first] = [ends[0], 0.3 * d.size[1]];
        // It begins level, where its tip can be seen.
        const seen = (a) => [0, 1].every((i) => Math.abs(tail[i] + unit(a)[i] * first - d.size[i] / 2) < d.size[i] / 2 - 5);
        const turn = [0, 180, 90, -90].find(seen) || 0;
        return { at, d, about, kind: about.kind, phase: "direction", tail, angle: degrees(by), far: far / large, large, squares: squaresOf(d), turn, length: first / large };
      }
      return null;
    }

    /** Where two lines cross, in the window: the image of a point, or the dot of a vertex. */
    function crossingOf(d, about, of, k) {
      const place = points[about.point]?.vectors[of.level]?.frame(k);
      if (place) return Number.isNaN(place[0]) || !added(d, of.n).length ? null : inWindow(d, place);
      const dot = added(d, of.n).find((e) => e.classList.contains("vertex"));
      if (!dot) return null;
      const { x, y, width, height } = dot.getBBox();
      return [x + width / 2, y + height / 2];
    }

    /** The directions along and square to all that the polygon draws: those of the lines that set squares are laid along. */
    function squaresOf(d) {
      const all = [0];
      for (const of of steps.filter((s) => s.key === d.key)) {
        const u = directionOf(d, of.n);
        if (u) all.push(degrees(u));
      }
      return [...new Set(all.flatMap((a) => [0, 90, 180, 270].map((q) => Math.round(within(a + q) * 1000) / 1000)))].sort((a, b) => a - b);
    }

    const formula = (n) => (n >= 0 ? formulaList[n] : "");
    const name = () => formula(task.about.symbol);
    const mu = () => data.scales[drawings.indexOf(task.d)];
    const plain = (html) => {
      const e = document.createElement("span");
      e.innerHTML = html;
      return e.textContent;
    };

    function ask() {
      while (step < steps.length && !(task = taskOf(step))) go(step + 1);
      tries = clues = 0;
      verdict("", "");
      if (!task) {
        said = "";
        verdict("good", `${word("predict_done")} ${score()}`);
      } else {
        asked++;
        present(task.d.key);
        tip.style.display = "";
        task.d.svg.append(tip);
        tip.focus({ preventScroll: true });
      }
      face();
      reveal();
      tell();
      overlay(locate(travel));
    }

    /** Draws what is laid off so far. */
    function draw() {
      tip.style.display = task ? "" : "none";
      if (!task) return;
      const { d, kind, large } = task;
      let at;
      if (kind === "x") at = task.guess;
      else {
        const u = unit(task.turn);
        const long = task.length * large;
        at = [task.tail[0] + u[0] * long, task.tail[1] + u[1] * long];
        if (kind === "d") {
          const reach = Math.hypot(...d.size);
          drawn("path", { class: "guess", d: line([-1, 1].map((s) => [task.tail[0] + s * u[0] * reach, task.tail[1] + s * u[1] * reach])) }, d.over);
        } else arrowTo(d.over, "guess", task.tail, at);
        drawn("circle", { class: "guess", cx: task.tail[0], cy: task.tail[1], r: 0.9 }, d.over);
      }
      tip.setAttribute("transform", `translate(${at.map(rounded).join(" ")})`);
      const value = told_();
      tip.setAttribute("aria-label", word("tip", plain(name())));
      tip.setAttribute("aria-valuenow", Math.round(kind === "x" ? at[0] : task.phase === "length" ? task.length : task.turn));
      tip.setAttribute("aria-valuetext", value);
      $("guess").textContent = value;
    }

    function told_() {
      if (task.kind === "x") {
        const pole = inWindow(task.d, [0, 0]);
        return [task.guess[0] - pole[0], pole[1] - task.guess[1]].map((v) => (v / task.large).toFixed(1)).join(" · ") + " mm";
      }
      const turned = `∠ ${Math.round(within(task.turn) * 10) / 10}°`.replace("-", "−");
      return task.phase === "length" ? `${task.length.toFixed(1)} mm, ${turned}` : turned;
    }

    /** The question. */
    function says() {
      if (!task) return "";
      const { about, kind, phase } = task;
      if (kind === "x") return word("ask_crossing");
      if (kind === "d") return word("ask_line", name());
      return phase === "direction" ? word("ask_direction", name()) : word("ask_length", name(), formula(mu()));
    }

    /** What is wrong with a direction; "" where it is right. */
    function wrongDirection() {
      const { about, kind } = task;
      const off = kind === "d" ? within(2 * (task.turn - task.angle)) / 2 : within(task.turn - task.angle);
      if (Math.abs(off) <= TURNED) return "";
      const direction = formula(about.direction);
      const across = about.direction >= 0 && /⊥|⟂/.test(plain(direction));
      if (Math.abs(Math.abs(off) - 180) <= TURNED) {
        if (about.sense === "t" && about.rate >= 0) return word("wrong_sense", formula(about.rate));
        if (about.sense === "k" && about.rate >= 0) return word("wrong_coriolis", formula(about.rate));
        if (about.sense === "n") return word("wrong_centre", direction);
        if (about.line < 0 && !direction) return word("wrong_opposite");
        return word("wrong_way", about.line >= 0 ? formula(about.line) : direction);
      }
      if (Math.abs(Math.abs(off) - 90) <= TURNED && about.line >= 0) return word(across ? "wrong_square" : "wrong_along", formula(about.line));
      if (about.direction < 0) return word("wrong_angle", Math.round(Math.abs(off)));
      return word("wrong_off", Math.round(Math.abs(off)), direction);
    }

    /** How far a mark may be off in this window (mm of paper). */
    function tolerance() {
      const px = task.d.svg.getScreenCTM().a * task.large;
      return Math.max(2 * data.pencil, STEP_MM / 2 + data.pencil, POINTED_PX / px);
    }

    function wrongLength() {
      const off = task.length - task.far;
      if (Math.abs(off) <= tolerance()) return "";
      return word(off > 0 ? "wrong_long" : "wrong_short", Math.abs(off).toFixed(1), formula(mu()));
    }

    function wrongPlace() {
      const off = Math.hypot(task.guess[0] - task.target[0], task.guess[1] - task.target[1]) / task.large;
      return off <= tolerance() ? "" : word("wrong_place", off.toFixed(1));
    }

    function check() {
      if (!task) return ask();
      const wrong = task.phase === "place" ? wrongPlace() : task.phase === "direction" ? wrongDirection() : wrongLength();
      if (wrong) {
        tries++;
        verdict("bad", wrong);
        return tell();
      }
      if (task.phase === "direction" && task.kind === "l") {
        task.phase = "length";
        task.turn = task.angle;
        clues = 0;
        verdict("good", word("right_direction"));
        tell();
        return overlay(locate(travel));
      }
      if (task.helped) helped++;
      else if (!tries) right++;
      done("good", word(tries || task.helped ? "right_now" : "right"));
    }

    function verdict(kind, text) {
      const box = $("verdict");
      box.innerHTML = text;
      box.className = kind;
    }

    /** How many were right at the first try and without help, of those asked; with help; shown. */
    function score() {
      const parts = [word("score", right, asked)];
      if (helped) parts.push(word("score_helped", helped));
      if (given) parts.push(word("score_shown", given));
      return parts.join(lang === "en" ? " " : "");
    }

    /** What helps at this point, from the general to the particular; never the answer. */
    function hints() {
      const { about, kind, phase } = task;
      if (kind === "x") return [word("clue_crossing")];
      if (phase === "length") return [word("clue_length", formula(mu()))];
      const direction = formula(about.direction);
      const across = /⊥|⟂/.test(plain(direction));
      const list = [];
      if (about.line >= 0) list.push(word(across ? "clue_square" : "clue_along", formula(about.line)));
      if (kind !== "d" && about.sense === "t" && about.rate >= 0) list.push(word("clue_sense", formula(about.rate)));
      if (about.sense === "k" && about.rate >= 0) list.push(word("clue_coriolis", formula(about.rate)));
      if (about.sense === "n") list.push(word("clue_centre"));
      return list.length ? list : [word("clue_angle")];
    }

    function hint() {
      if (!task) return;
      const list = hints();
      clues = Math.min(clues + 1, list.length);
      task.helped = true;
      verdict("", list.slice(0, clues).join(lang === "en" ? " " : ""));
      face();
    }

    /** The step is shown, with its sentence. */
    function done(kind, text) {
      task = null;
      verdict(kind, `${text} ${score()}`);
      go(step + 1);
      face();
    }

    /** Shows the answer of what was not found. */
    function giveUp() {
      if (!task) return ask();
      given++;
      done("bad", word("shown"));
    }

    // By pointer: the tip follows the hand; the ray lies along a set square that it comes near to.
    let hand = null;
    tip.addEventListener("pointerdown", (event) => {
      if (!task || event.button !== 0) return;
      hand = event.pointerId;
      tip.setPointerCapture(hand);
      tip.focus({ preventScroll: true });
      event.preventDefault();
    });
    tip.addEventListener("pointermove", (event) => {
      if (hand === null || event.pointerId !== hand || !task) return;
      const p = pointed(task.d, event);
      if (task.kind === "x") task.guess = p;
      else {
        const by = [p[0] - task.tail[0], p[1] - task.tail[1]];
        if (task.phase === "direction") {
          if (Math.hypot(...by) < 1) return;
          const a = degrees(by);
          const near = task.squares.find((q) => Math.abs(within(q - a)) < SNAP);
          task.turn = near === undefined ? Math.round(a) : near;
          task.length = Math.min(Math.hypot(...by), 0.6 * task.d.size[1]) / task.large;
        } else {
          const u = unit(task.turn);
          task.length = Math.max(STEP_MM, Math.round((by[0] * u[0] + by[1] * u[1]) / task.large / STEP_MM) * STEP_MM);
        }
      }
      overlay(locate(travel));
    });
    for (const name of ["pointerup", "pointercancel"]) tip.addEventListener(name, () => (hand = null));

    /** By keys and buttons: turns or lengthens by a little, or by a lot. */
    function nudge(x, y, much) {
      if (!task) return;
      if (task.kind === "x") {
        const by = (much ? 5 : STEP_MM / 2) * task.large;
        task.guess = [task.guess[0] + x * by, task.guess[1] - y * by];
      } else if (task.phase === "direction") {
        const way = y || -x;
        if (much) {
          const ahead = task.squares.map((q) => (((way * (q - task.turn)) % 360) + 360) % 360).filter((a) => a > 0.01);
          task.turn = within(task.turn + way * Math.min(...ahead));
        } else task.turn = within(Math.round(task.turn + way));
      } else {
        const by = (y || x) * (much ? 5 : STEP_MM);
        task.length = Math.max(STEP_MM, Math.round((task.length + by) / STEP_MM) * STEP_MM);
      }
      overlay(locate(travel));
    }
    tip.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (by) nudge(...by, event.shiftKey);
      else if (event.key === "Enter") check();
      else return;
      event.preventDefault();
      event.stopPropagation();
    });

    const leave = () => tip.remove();
    /** What the equation hides; see told.js. */
    const hides = () => (!task ? 0 : task.kind !== "x" && task.phase === "direction" ? 2 : 1);
    return { ask, draw, says, check, hint, giveUp, nudge, leave, hides, asking: () => !!task };
  }

  function predict() {
    if (predicting) {
      predicting.leave();
      predicting = null;
      $("verdict").textContent = $("guess").textContent = "";
      polygons.forEach(legible);
      face();
      return go(step);
    }
    stop();
    settle();
    predicting = predictor();
    polygons.forEach(legible);
    $("verdict").textContent = "";
    if (step === steps.length) step = 0;
    predicting.ask();
  }
