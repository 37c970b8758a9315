// The drawing board: the plane with its grid, the mechanism on it, and where the pointer is.

import { element } from './dom'
import type { Target } from './acts'
import { distance, minus, type Outline, type XY } from './outline'
import type { Grain } from './quantities'
import { inPlane, offLink, onScreen, outlineOf, svg, type View } from './sketch'

/** Distances (pixels) at which the pointer takes a point and a line. */
const NEAR = [11, 7] as const
/** Pixels of a millimetre of paper, for sketches and before the first drawing. */
export const MILLIMETRE = 4

/** Marks over the mechanism. */
export interface Marks {
  selected?: { kind: 'point' | 'link'; name: string } | null
  /** Places of the steps that were made, and the link that may be extended. */
  pending: XY[]
  armed?: string | null
  /** True if a line follows the pointer from the last step. */
  band: boolean
  tool: boolean
}

export class Board {
  readonly root = element('div', { class: 'board', tabindex: '0' })
  view: View = { scale: 1200, x: 0, y: 0 }
  outline: Outline | null = null
  /** Drawing while a joint is dragged. */
  trial: Outline | null = null
  grain: Grain | null = null
  /** The place of the pointer (m), snapped, and what is there. */
  pointer: Target | null = null
  marks: Marks = { pending: [], band: false, tool: false }
  private grid = svg('g', { class: 'lines' })
  private drawing = svg('g', {})
  private over = svg('g', { class: 'over' })
  private screen = svg('svg', { class: 'screen', 'aria-hidden': 'true' }, this.grid, this.drawing, this.over)

  constructor() {
    this.root.append(this.screen)
  }

  get size(): XY {
    return [this.root.clientWidth, this.root.clientHeight]
  }

  /** The pixel of an event on the board. */
  pixel(event: MouseEvent): XY {
    const box = this.root.getBoundingClientRect()
    return [event.clientX - box.left, event.clientY - box.top]
  }

  /** The object at a pixel: a point before a link, a link before the plane; its place is snapped. */
  target(pixel: XY, fine: boolean): Target {
    const { outline, view, grain } = this
    const at = inPlane(view, pixel)
    const snapped = grain ? grain.snap(at, fine) : at
    if (!outline) return { at: snapped }
    const off = (name: string) => distance(onScreen(view, outline.places.get(name)!), pixel)
    const points = outline.points.filter((p) => outline.places.has(p) && off(p) < NEAR[0]).sort((a, b) => off(a) - off(b))
    if (points[0] !== undefined) return { point: points[0], at: outline.places.get(points[0])! }
    const block = outline.guides.find((g) => g.slider !== undefined && g.at && distance(onScreen(view, g.at), pixel) < 17)
    if (block) return { link: block.slider!, at }
    const links = [...outline.links.keys()].filter((l) => l !== outline.ground && offLink(outline, l, at) * view.scale < NEAR[1])
    // The smallest one lies on top.
    const link = links.sort((a, b) => outline.links.get(a)!.length - outline.links.get(b)!.length)[0]
    return link === undefined ? { at: snapped } : { link, at }
  }

  /** True if a pixel is on the support of a pivot. */
  onGround(pixel: XY): boolean {
    const { outline, view } = this
    return (outline?.points ?? []).some((p) => {
      const place = outline!.fixed(p) ? outline!.places.get(p) : undefined
      const [x, y] = place ? minus(pixel, onScreen(view, place)) : [Infinity, 0]
      return Math.abs(x) < 6 * MILLIMETRE && y > 0 && y < 7 * MILLIMETRE
    })
  }

  /** Shows a drawing: the engine's, or a sketch. */
  show(drawing: SVGElement): void {
    this.drawing.replaceChildren(drawing)
    this.refresh()
  }

  /** Draws grid and marks anew. */
  refresh(): void {
    const [width, height] = this.size
    if (!width || !height) return
    this.screen.setAttribute('viewBox', `0 0 ${width} ${height}`)
    this.drawGrid(width, height)
    this.drawMarks()
  }

  private drawGrid(width: number, height: number): void {
    const { view, grain } = this
    if (!grain) return
    const step = grain.grid * view.scale
    const lines = (every: number, least: number) => {
      let d = ''
      const first = (at: number) => ((at % (step * every)) + step * every) % (step * every)
      for (let x = first(view.x); x < width; x += step * every) d += `M${x.toFixed(1)} 0V${height}`
      for (let y = first(view.y); y < height; y += step * every) d += `M0 ${y.toFixed(1)}H${width}`
      return svg('path', { class: `every-${least}`, d })
    }
    this.grid.replaceChildren(lines(1, 1), lines(5, 5))
  }

  private drawMarks(): void {
    const { view, marks, pointer } = this
    const outline = this.trial ?? this.outline
    const made: SVGElement[] = []
    const dot = (at: XY, cls: string, r = 8) => {
      const [x, y] = onScreen(view, at)
      made.push(svg('circle', { class: cls, cx: x, cy: y, r }))
    }
    const mark = (kind: 'point' | 'link', name: string, cls: string) => {
      const at = outline?.places.get(name)
      if (kind === 'point' && at) dot(at, cls)
      if (kind === 'link' && outline?.links.has(name)) made.push(svg('path', { class: cls, d: outlineOf(outline, name, view) }))
    }
    if (marks.selected) mark(marks.selected.kind, marks.selected.name, 'selected')
    if (marks.armed) mark('link', marks.armed, 'armed')
    if (pointer?.point !== undefined) mark('point', pointer.point, 'hovered')
    else if (pointer?.link !== undefined) mark('link', pointer.link, 'hovered')
    marks.pending.forEach((at) => dot(at, 'made', 4.5))
    const last = marks.pending.at(-1)
    if (pointer && marks.tool) {
      const [x, y] = onScreen(view, pointer.at)
      if (last && marks.band) {
        const [a, b] = onScreen(view, last)
        made.push(svg('path', { class: 'band', d: `M${a} ${b}L${x} ${y}` }))
        const length = this.grain?.length(Math.hypot(...minus(pointer.at, last)))
        made.push(svg('text', { class: 'measure', x: (a + x) / 2 + 8, y: (b + y) / 2 - 8 }, length ?? ''))
      }
      if (pointer.point === undefined) made.push(svg('path', { class: 'cross', d: `M${x - 6} ${y}h12M${x} ${y - 6}v12` }))
    }
    this.over.replaceChildren(...made)
  }

  /** Brings everything into view. */
  fit(): void {
    const [width, height] = this.size
    const { outline } = this
    const places = [...(outline?.places.values() ?? [])]
    for (const w of outline?.wheels ?? []) {
      const c = outline!.places.get(w.centre)
      // A cam reaches beyond its base circle, and so does the guide of its follower.
      const r = w.radius * (w.kind === 'cam' ? 1.8 : w.kind === 'roller' ? 3 : 1)
      if (c) places.push([c[0] - r, c[1] - r], [c[0] + r, c[1] + r])
    }
    if (!width || !height) return
    if (places.length < 2) {
      this.view = { scale: this.view.scale, x: Math.round(width * 0.28), y: Math.round(height * 0.6) }
      return
    }
    const range = (k: 0 | 1): [number, number] => [Math.min(...places.map((p) => p[k])), Math.max(...places.map((p) => p[k]))]
    const [[x0, x1], [y0, y1]] = [range(0), range(1)]
    const scale = Math.min((width - 150) / Math.max(x1 - x0, 1e-9), (height - 130) / Math.max(y1 - y0, 1e-9), 5e4)
    this.view = { scale, x: (width - (x0 + x1) * scale) / 2, y: (height + (y0 + y1) * scale) / 2 }
  }

  zoom(by: number, pixel: XY): void {
    const scale = Math.min(Math.max(this.view.scale * by, 1e-6), 1e9)
    const at = inPlane(this.view, pixel)
    this.view = { scale, x: pixel[0] - at[0] * scale, y: pixel[1] + at[1] * scale }
  }

  pan(by: XY): void {
    this.view = { ...this.view, x: this.view.x + by[0], y: this.view.y + by[1] }
  }
}
