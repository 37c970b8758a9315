
  // ---- what is drawn over the drawings ----------------------------------------------------------------------------

  const shows = { path: false, velocity: false, acceleration: false, hodograph: false };
  /** Which points are followed. */
  const followed = new Set();
  points.forEach((p, i) => p.moves && p.asked && followed.add(i));
  if (!followed.size) points.forEach((p, i) => p.moves && followed.add(i));
  /** Where the hodographs began to grow. */
  let grown = null;

  /** Vectors on the mechanism are at most so much of its window long. */
  const LONGEST = 0.3;

  const longest = [0, 1].map((i) => {
    const ends = points.flatMap((p) => (p.vectors[i] && p.moves ? times.map((_, k) => Math.hypot(...p.vectors[i].frame(k))) : []));
    const known = ends.filter((far) => far > 0).sort((a, b) => a - b);
    // Next to a limit vectors grow beyond all bounds: nine tenths of all are drawn true to one scale, the others cut.
    return known.length ? known[Math.floor(known.length * 0.95)] : 1;
  });

  const line = (list) => `M${list.map((p) => p.map(rounded).join(" ")).join("L")}`;

  /** A curve through frames, broken where it is not known. */
  function curve(list, closed) {
    let path = "";
    let open = [];
    for (const p of list) {
      if (p && !Number.isNaN(p[0])) open.push(p);
      else if (open.length) (path += line(open)), (open = []);
    }
    if (open.length) path += line(open);
    return path + (closed && path ? "Z" : "");
  }

  function vector(parent, kind, from, by, far) {
    const room = LONGEST * Math.min(...mechanism.size);
    const size = Math.hypot(...by);
    if (!(size > 0)) return;
    const k = Math.min(room / far, room / size);
    const tip = [from[0] + by[0] * k, from[1] - by[1] * k];
    arrowTo(parent, kind, from, tip);
  }

  /** An arrow drawn by the page. */
  function arrowTo(parent, kind, from, tip) {
    const far = Math.hypot(tip[0] - from[0], tip[1] - from[1]) || 1;
    const [ux, uy] = [(tip[0] - from[0]) / far, (tip[1] - from[1]) / far];
    const back = Math.min(3.2, far * 0.5);
    const at = (t, s) => [tip[0] - ux * t + uy * s, tip[1] - uy * t - ux * s];
    drawn("path", { class: kind, d: line([from, at(back * 0.8, 0)]) }, parent);
    drawn("path", { class: `${kind} head`, d: `${line([at(0, 0), at(back, back * 0.2), at(back * 0.8, 0), at(back, -back * 0.2)])}Z` }, parent);
  }

  /** Where a hodograph has come to: the frames from where the motion began to where it is. */
  function grownFrames(here) {
    if (grown === null) return [...times.keys()];
    const { from, way } = grown;
    const whole = data.full && way.length >= count;
    if (whole) return [...times.keys(), 0];
    return [from, ...way, here];
  }

  function overlay(where) {
    const k = near(where);
    for (const d of drawings) {
      d.over.replaceChildren();
      d.under.replaceChildren();
    }
    const seen = [...followed].map((i) => points[i]).filter((p) => p.place);
    const m = (p) => inWindow(mechanism, p);
    for (const p of seen) {
      const at = p.place(where);
      if (Number.isNaN(at[0])) continue;
      if (shows.path) {
        const all = times.map((_, f) => (p.place.seen[f] ? m(p.place.frame(f)) : null));
        drawn("path", { class: "path", d: curve(all, data.full) }, mechanism.under);
      }
      ["velocity", "acceleration"].forEach((kind, i) => {
        const v = shows[kind] && p.vectors[i] && p.vectors[i](where);
        if (v && !Number.isNaN(v[0])) vector(mechanism.over, `vector ${kind}`, m(at), v, longest[i]);
      });
    }
    if (shows.hodograph) {
      const frames = grownFrames(k);
      for (const d of polygons) {
        if (!d.shown[k]) continue;
        for (const p of seen) {
          const ends = p.vectors[d.level];
          if (!ends) continue;
          const list = frames.map((f) => (ends.seen[f] ? inWindow(d, ends.frame(f)) : null));
          if (grown !== null) list.push(inWindow(d, ends(where)));
          drawn("path", { class: "hodograph", d: curve(list) }, d.under);
        }
      }
    }
    light(k, where);
    if (predicting) predicting.draw(where);
  }

  /** The link of a step lights up, and the line to which its vector is square or parallel is drawn through its point. */
  function light(k, where) {
    const at = predicting && predicting.asking() ? step : marked ? step - 1 : -1;
    const of = steps[at];
    const about = of ? act(of, k) : null;
    const lit = about ? about.links : [];
    for (const e of mechanism.svg.querySelectorAll(".ink [data-l]")) e.classList.toggle("lit", lit.includes(Number(e.dataset.l)));
    const d = of && drawing(of.key);
    if (!about || !about.sense || !d || !d.shown[k] || (predicting && predicting.asking())) return;
    const direction = directionOf(d, of.n);
    const p = points[about.point];
    const q = points[about.seen];
    if (!direction || !p || !p.place) return;
    const here = inWindow(mechanism, p.place(where));
    const reach = 0.26 * Math.hypot(...mechanism.size);
    const on = (s) => [here[0] + direction[0] * s, here[1] + direction[1] * s];
    drawn("path", { class: "guide", d: line([on(-reach), on(reach)]) }, mechanism.over);
    if (!q || !q.place) return;
    const there = inWindow(mechanism, q.place(where));
    const arm = Math.hypot(there[0] - here[0], there[1] - here[1]);
    if (arm < 1) return;
    drawn("path", { class: "arm", d: line([here, there]) }, mechanism.over);
    const u = [(there[0] - here[0]) / arm, (there[1] - here[1]) / arm];
    const across = Math.abs(u[0] * direction[0] + u[1] * direction[1]) < 1e-2;
    if (!across) return;
    const s = 2.6;
    const corner = [on(s), [on(s)[0] + u[0] * s, on(s)[1] + u[1] * s], [here[0] + u[0] * s, here[1] + u[1] * s]];
    drawn("path", { class: "square", d: line(corner) }, mechanism.over);
  }

  /** Where an arrow of a drawing begins and ends. */
  function endsOf(element) {
    const [shaft, head] = [element.querySelector("line"), element.querySelector("path")];
    if (!shaft || !head) return null;
    const tip = head.getAttribute("d").match(/-?[\d.]+/g);
    return [["x1", "y1"].map((a) => Number(shaft.getAttribute(a))), tip.slice(0, 2).map(Number)];
  }

  /** The elements that an action of a drawing adds. */
  const added = (d, n) => seenThrough(d).stepped.filter((s) => s.step === n && s.element.getAttribute("display") !== "none").map((s) => s.element);

  /** The unit direction of what an action of a drawing draws, y down. */
  function directionOf(d, n) {
    for (const e of added(d, n)) {
      const ends = e.tagName === "line" && e.classList.contains("construction")
        ? [["x1", "y1"], ["x2", "y2"]].map((names) => names.map((a) => Number(e.getAttribute(a))))
        : e.tagName === "g" && !e.classList.contains("label") ? endsOf(e) : null;
      if (!ends) continue;
      const by = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
      const far = Math.hypot(...by);
      if (far > 1e-3) return by.map((v) => v / far);
    }
    return null;
  }
