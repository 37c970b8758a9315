"use strict";
// The page at work: decodes the frames, moves the drawings, tells the steps. It draws nothing of the library's anew: every element
// stands in the page, and only its numbers and whether it is seen change. This room reads numbers over the frames.
(async () => {
  const pressed = Uint8Array.from(atob(document.getElementById("data").textContent), (c) => c.charCodeAt(0));
  const opened = new Blob([pressed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const data = JSON.parse(await new Response(opened).text());
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

  /** The value of a column at a place: the curve of curve.rs, or a straight line for labels. */
  function value(column, where, straight) {
    const { k, s } = where;
    if (s === 0 || s === 1) return column[frame(k + s)];
    const known = (i) => inside(i) && !Number.isNaN(column[frame(i)]);
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

