// The mechanism as its text has it, drawn without the engine: while it cannot be solved.

import { distance, left, minus, plus, toward, unit, type Outline, type XY } from './outline'

/** Where the plane is on the screen: pixels of a metre, and of its origin. */
export interface View { scale: number; x: number; y: number }

export const onScreen = (view: View, at: XY): XY => [view.x + at[0] * view.scale, view.y - at[1] * view.scale]
export const inPlane = (view: View, at: XY): XY => [(at[0] - view.x) / view.scale, (view.y - at[1]) / view.scale]

const SPACE = 'http://www.w3.org/2000/svg'

export function svg(tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
  const made = document.createElementNS(SPACE, tag)
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(typeof value === 'number' ? Math.round(value * 100) / 100 : value))
  made.append(...children)
  return made
}

const path = (points: XY[], closed = false) => points.map(([x, y], k) => `${k ? 'L' : 'M'}${x.toFixed(2)} ${y.toFixed(2)}`).join('') + (closed ? 'Z' : '')

/** Corners in the order around their middle: a body of more than two points is a polygon. */
function around(points: XY[]): XY[] {
  const middle = points.reduce((sum, p) => plus(sum, p, 1 / points.length), [0, 0] as XY)
  const angle = (p: XY) => Math.atan2(p[1] - middle[1], p[0] - middle[0])
  return [...points].sort((a, b) => angle(a) - angle(b))
}

/** The drawing; `mm` is the size of a millimetre of paper in pixels: lines and signs are as large as in the figure. */
export function sketch(outline: Outline, view: View, mm: number): SVGElement {
  const out = svg('g', { class: 'sketch' })
  const at = (name: string) => {
    const place = outline.places.get(name)
    return place && onScreen(view, place)
  }
  const thin = 0.25 * mm
  const line = 0.4 * mm
  const add = (tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]) => out.append(svg(tag, attributes, ...children))
  const hatched = (from: XY, along: XY, length: number, down: XY) => {
    const strokes: XY[][] = []
    for (let s = 1; s < length / mm; s += 1.45) {
      const a = plus(from, along, s * mm)
      strokes.push([a, plus(plus(a, along, -1.8 * mm), down, 1.8 * mm)])
    }
    add('path', { class: 'hatch', d: strokes.map((s) => path(s)).join(''), 'stroke-width': thin })
    add('path', { class: 'line', d: path([from, plus(from, along, length)]), 'stroke-width': line })
  }
  for (const wheel of outline.wheels) {
    const centre = at(wheel.centre)
    const dash: Record<string, string> = wheel.kind === 'gear' ? { 'stroke-dasharray': [4, 0.8, 0.4, 0.8].map((d) => d * mm).join(' ') } : {}
    if (centre) add('circle', { class: 'wheel', cx: centre[0], cy: centre[1], r: wheel.radius * view.scale, 'stroke-width': line, ...dash })
  }
  for (const track of outline.tracks) {
    const [place, u]: XY[] = [onScreen(view, track.at), [track.direction[0], -track.direction[1]]]
    // The wheel is to the left: the ground is on the other side.
    if (track.fixed) hatched(plus(place!, u!, -10 * mm), u!, 20 * mm, left([-u![0], -u![1]]).map((v) => -v) as XY)
    else add('path', { class: 'line', d: path([plus(place!, u!, -10 * mm), plus(place!, u!, 10 * mm)]), 'stroke-width': line })
  }
  for (const guide of outline.guides) {
    const place = guide.at && onScreen(view, guide.at)
    if (!place) continue
    const u: XY = guide.direction ? [guide.direction[0], -guide.direction[1]] : [1, 0]
    // On the screen y is down: the side away from the upper one.
    const down: XY = u[0] >= 0 ? [-u[1], u[0]] : [u[1], -u[0]]
    if (guide.on === outline.ground) hatched(plus(plus(place, down, 2.2 * mm), u, -13 * mm), u, 26 * mm, down)
    const corner = (a: number, b: number) => plus(plus(place, u, a * 4 * mm), down, b * 2.2 * mm)
    if (guide.slider !== undefined) add('path', { class: 'block', d: path([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)], true), 'stroke-width': line })
  }
  for (const name of outline.links.keys()) {
    if (name === outline.ground) continue
    const points = outline.placesOn(name)
    const corners = around(points).map((p) => onScreen(view, p))
    if (corners.length >= 2) add('path', { class: corners.length > 2 ? 'body' : 'bar', d: path(corners, corners.length > 2), 'stroke-width': 0.7 * mm })
    const label = number(outline, name, points, (4 * mm) / view.scale)
    if (label) add('text', { class: 'number', x: onScreen(view, label)[0], y: onScreen(view, label)[1] + 1.6 * mm, 'text-anchor': 'middle', 'font-size': 4.6 * mm }, name)
  }
  for (const name of outline.points) {
    const place = at(name)
    if (!place) continue
    const [x, y] = place
    if (outline.fixed(name)) {
      add('path', { class: 'support', d: path([[x, y], [x + 2.9 * mm, y + 4.4 * mm], [x - 2.9 * mm, y + 4.4 * mm]], true), 'stroke-width': line })
      hatched([x - 5.6 * mm, y + 4.4 * mm], [1, 0], 11.2 * mm, [0, 1])
    }
    const carriers = outline.carriers(name).length + outline.guides.filter((g) => g.pin === name && g.slider === undefined).length
    if (carriers > 1 || outline.fixed(name) || !carriers) add('circle', { class: 'pin', cx: x, cy: y, r: 1.1 * mm, 'stroke-width': line })
    else add('circle', { class: 'dot', cx: x, cy: y, r: 0.6 * mm })
    add('text', { class: 'letter', x: x - 1.6 * mm, y: y - 1.9 * mm, 'font-size': 4.6 * mm, 'text-anchor': 'end' }, name)
  }
  return out
}

/** Where the number of a link is written: `off` (m) beside it. */
function number(outline: Outline, name: string, points: XY[], off: number): XY | null {
  const guide = outline.guides.find((g) => g.slider === name)
  const [a, b, c] = points
  if (a && b && c) return [(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3]
  if (a && b) {
    const beside = left(unit(minus(b, a)))
    return plus(plus(a, minus(b, a), 0.5), beside[1] < 0 ? [-beside[0], -beside[1]] : beside, off)
  }
  if (guide?.at) return plus(guide.at, [1.6 * off, 0.6 * off])
  const wheel = outline.wheels.find((w) => w.link === name)
  const centre = wheel && outline.places.get(wheel.centre)
  return centre ? plus(centre, toward(0.8), wheel!.radius + 0.6 * off) : null
}

/** The distance (m) of a place from the lines of a link. */
export function offLink(outline: Outline, link: string, at: XY): number {
  const points = outline.placesOn(link)
  let least = Infinity
  const corners = around(points)
  corners.forEach((a, k) => {
    const b = corners[(k + 1) % corners.length]!
    if (a === b || (corners.length === 2 && k)) return
    const along = minus(b, a)
    const part = Math.min(Math.max((along[0] * (at[0] - a[0]) + along[1] * (at[1] - a[1])) / (along[0] ** 2 + along[1] ** 2 || 1), 0), 1)
    least = Math.min(least, distance(at, plus(a, along, part)))
  })
  // Inside a body.
  if (corners.length > 2 && corners.every((a, k) => dotLeft(a, corners[(k + 1) % corners.length]!, at) >= 0)) least = 0
  for (const wheel of outline.wheels) {
    const centre = wheel.link === link ? outline.places.get(wheel.centre) : undefined
    if (centre) least = Math.min(least, Math.abs(distance(at, centre) - wheel.radius))
  }
  return least
}

const dotLeft = (a: XY, b: XY, at: XY) => {
  const n = left(minus(b, a))
  return n[0] * (at[0] - a[0]) + n[1] * (at[1] - a[1])
}

/** The lines of a link on the screen, to mark it. */
export function outlineOf(outline: Outline, link: string, view: View): string {
  const points = outline.placesOn(link)
  const corners = around(points).map((p) => onScreen(view, p))
  const circles = outline.wheels.filter((w) => w.link === link).flatMap((w) => {
    const centre = outline.places.get(w.centre)
    if (!centre) return []
    const [x, y] = onScreen(view, centre)
    const r = w.radius * view.scale
    return [`M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`]
  })
  const blocks = outline.guides.filter((g) => g.slider === link && g.at).map((g) => {
    const [x, y] = onScreen(view, g.at!)
    return `M${x - 14} ${y}l28 0`
  })
  return (corners.length >= 2 ? path(corners, corners.length > 2) : '') + circles.join('') + blocks.join('')
}
