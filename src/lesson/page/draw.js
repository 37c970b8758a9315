
  // ---- drawings ---------------------------------------------------------------------------------------------------
  // Each stands in a window of its own, or in two: one that the given position fills, one that holds all positions; see scenery.rs.

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
  function arrow(element, ends, [length, width, notch, most]) {
    const [line, head] = element.children;
    return (where) => {
      const [x1, y1, x2, y2] = ends.map((values) => value(values, where, false));
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

  const SVG = "http://www.w3.org/2000/svg";

  /** An SVG element with attributes. */
  function drawn(name, attributes, parent) {
    const element = document.createElementNS(SVG, name);
    for (const [key, v] of Object.entries(attributes)) element.setAttribute(key, v);
    if (parent) parent.append(element);
    return element;
  }

  function layoutOf(ink, { mu, times: large, origin, held, back, moving, with: key = null }) {
    const elements = [...ink.children];
    const earlier = [];
    const movers = moving.map(([index, runs, places, packed]) => {
      const element = elements[index];
      const seen = flags(runs);
      const read = reader(packed, earlier);
      const length = seen.filter(Boolean).length;
      const attributes = places.map((place) => {
        const [part, name, ...numerals] = place.split(" ");
        if (name === "arrow") {
          const ends = [1, 2, 3, 4].map(() => spread(read(length), seen));
          return arrow(element, ends, numerals.map(Number));
        }
        const target = part === "0" ? element : element.querySelectorAll("*")[part - 1];
        const parts = pieces(target.getAttribute(name));
        const columns = numerals.map((n) => ({ at: 2 * n + 1, values: spread(read(length), seen) }));
        const straight = name === "transform";
        return (where) => {
          for (const { at, values } of columns) parts[at] = rounded(value(values, where, straight));
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
    return { ink, key, mu, times: large, origin, held: flags(held), back: stretched(back), movers, stepped };
  }

  const drawings = data.drawings.map(({ key, level, part, shown, layouts }) => {
    const figure = $(key);
    const svg = figure.querySelector("svg");
    const inks = layouts.map(({ markup }) => {
      if (!markup) return svg.querySelector(".ink");
      const ink = drawn("g", { class: "ink", display: "none" }, svg);
      ink.innerHTML = markup;
      return ink;
    });
    const { width, height } = svg.viewBox.baseVal;
    const over = drawn("g", { class: "over" }, svg);
    const under = drawn("g", { class: "under" });
    svg.prepend(under);
    return {
      key,
      level,
      part,
      figure,
      svg,
      over,
      under,
      shown: flags(shown),
      off: figure.querySelector(".off"),
      layouts: layouts.map((told, i) => layoutOf(inks[i], told)),
      views: layouts.filter((l) => !l.with).length,
      now: 0,
      size: [width, height],
      zoom: { times: 1, x: 0, y: 0 },
    };
  });
  const [mechanism, ...polygons] = drawings;
  const drawing = (key) => drawings.find((d) => d.key === key);

  /** The polygon that is seen. With a force polygon the mechanism shows the free bodies of its group, in frames that have them. */
  let presented = null;
  let bodies = null;
  /** The layout through which a drawing is seen now. */
  const seenThrough = (d) => d.layouts.find((l) => bodies && l.key === bodies) || d.layouts[d.now];

  /** A place of a drawing's paper (mm from the origin, y up) in its window. */
  function inWindow(d, [x, y]) {
    const { origin, times: large } = seenThrough(d);
    return [origin[0] + x * large, origin[1] - y * large];
  }

  /** Where the pointer is in a window. */
  function pointed(d, event) {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(d.svg.getScreenCTM().inverse());
    return [p.x, p.y];
  }

  function display(element, on) {
    if (on) element.removeAttribute("display");
    else element.setAttribute("display", "none");
  }

  /** Shows a drawing through one of its windows. */
  function look(d, index) {
    d.now = index;
    d.layouts.forEach((l) => display(l.ink, l === seenThrough(d)));
    const { mu, times: large, origin } = seenThrough(d);
    d.svg.dataset.mu = mu;
    d.svg.dataset.times = large;
    d.svg.dataset.origin = origin.join(" ");
    d.figure.classList.toggle("wide", index > 0);
  }

  /** The part of a window that is seen: all of it, what the reader has zoomed to, more where a vector is longer than it. */
  function frameWindow(d, k) {
    const [w, h] = d.size;
    const back = (seenThrough(d).back[k] || 100) / 100;
    const { times: by, x, y } = d.zoom;
    const [sw, sh] = [(w * back) / by, (h * back) / by];
    const box = [w / 2 + x - sw / 2, h / 2 + y - sh / 2, sw, sh].map(rounded).join(" ");
    if (d.svg.getAttribute("viewBox") !== box) d.svg.setAttribute("viewBox", box);
  }

  function move(where) {
    const nearest = near(where);
    const wanted = mechanism.layouts.find((l) => l.key === presented && l.held[nearest])?.key || null;
    if (wanted !== bodies) {
      bodies = wanted;
      look(mechanism, mechanism.now);
    }
    for (const d of drawings) {
      const on = d.shown[nearest];
      // What would leave the first window is seen through the second from then on.
      if (!seenThrough(d).held[nearest] && on) look(d, d.views - 1);
      const { ink, movers } = seenThrough(d);
      ink.style.display = on ? "" : "none";
      d.off.hidden = on;
      frameWindow(d, nearest);
      if (!on) continue;
      for (const { element, seen, attributes } of movers) {
        const visible = seen[nearest];
        if (visible !== (element.getAttribute("display") !== "none")) display(element, visible);
        if (!visible) continue;
        for (const draw of attributes) draw(where);
      }
    }
  }

  // ---- zoom and pan -----------------------------------------------------------------------------------------------

  const ZOOM = [0.5, 8];

  /** Zooms a window about one of its places. */
  function zoomBy(d, factor, about) {
    const z = d.zoom;
    const to = Math.min(Math.max(z.times * factor, ZOOM[0]), ZOOM[1]);
    const [w, h] = d.size;
    const [px, py] = about || [w / 2 + z.x, h / 2 + z.y];
    const part = z.times / to;
    [z.x, z.y] = [px - w / 2 - (px - w / 2 - z.x) * part, py - h / 2 - (py - h / 2 - z.y) * part];
    z.times = to;
    frameWindow(d, near(locate(travel)));
    d.figure.classList.toggle("zoomed", to !== 1 || z.x !== 0 || z.y !== 0);
  }

  function panBy(d, dx, dy) {
    d.zoom.x += dx;
    d.zoom.y += dy;
    zoomBy(d, 1);
  }

  function unzoom(d) {
    Object.assign(d.zoom, { times: 1, x: 0, y: 0 });
    zoomBy(d, 1);
  }

  for (const d of drawings) {
    const fingers = new Map();
    d.svg.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && !event.metaKey && !d.figure.classList.contains("zoomed")) return;
        zoomBy(d, Math.exp(-event.deltaY / 300), pointed(d, event));
        event.preventDefault();
      },
      { passive: false },
    );
    d.svg.addEventListener("pointerdown", (event) => {
      if (event.target.closest(".grip, .tip")) return;
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      // A finger alone scrolls the page unless the drawing is zoomed.
      if (event.pointerType !== "touch" || fingers.size > 1 || d.figure.classList.contains("zoomed")) {
        d.svg.setPointerCapture(event.pointerId);
      }
    });
    d.svg.addEventListener("pointermove", (event) => {
      const from = fingers.get(event.pointerId);
      if (!from) return;
      const to = [event.clientX, event.clientY];
      const px = d.svg.getScreenCTM().a;
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      if (other) {
        const far = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
        const middle = { clientX: (to[0] + other[0]) / 2, clientY: (to[1] + other[1]) / 2 };
        zoomBy(d, far(to) / Math.max(far(from), 1), pointed(d, middle));
      } else if (event.pointerType !== "touch" || d.figure.classList.contains("zoomed")) {
        panBy(d, (from[0] - to[0]) / px, (from[1] - to[1]) / px);
      }
      fingers.set(event.pointerId, to);
    });
    for (const name of ["pointerup", "pointercancel"]) d.svg.addEventListener(name, (event) => fingers.delete(event.pointerId));
    d.figure.querySelector(".nearer").addEventListener("click", () => zoomBy(d, 1.4));
    d.figure.querySelector(".farther").addEventListener("click", () => zoomBy(d, 1 / 1.4));
    d.figure.querySelector(".whole").addEventListener("click", () => unzoom(d));
  }

  // ---- points -----------------------------------------------------------------------------------------------------

  /** Every vertex of the plan: name, whether it moves on the mechanism, whether it is asked for, and where it and the ends of its
      vectors are (mm of paper, y up), each a function of the place in the travel; null where not told. See marks.rs. */
  const points = (() => {
    const { seen: runs, list, columns } = data.marks;
    const seen = runs.map(flags);
    const read = reader(columns, []);
    const pair = (i) => {
      const [x, y] = [0, 1].map(() => spread(read(seen[i].filter(Boolean).length), seen[i]));
      const at = (where) => [value(x, where), value(y, where)];
      at.frame = (k) => [x[k], y[k]];
      at.seen = seen[i];
      return at;
    };
    return list.map(([name, placed, moves, asked, symbols]) => {
      const place = placed ? pair(0) : null;
      const vectors = symbols.map((s, i) => (s < 0 ? null : pair(i + 1)));
      return { name, moves, asked, symbols, place, vectors };
    });
  })();
