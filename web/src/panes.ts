// The drawings: one pane for each, which keeps its place and size while the mechanism moves.

import { element, parts, picture } from './dom'
import type { Delta, Page } from './engine'

interface Box { x0: number; y0: number; x1: number; y1: number }

/** Pixels of a millimetre at 96 dots per inch. */
const PIXELS = 96 / 25.4
/** Gap between panes (pixels), and the greatest enlargement. */
const GAP = 22
const LARGEST = 1.9

/**
 * Puts panes on the stage in one scale, as on one sheet of paper: in a row, or the first beside the others, whichever is larger;
 * on a `narrow` stage as wide as it is, and at most `tallest` pixels high.
 */
export function arrange(stage: HTMLElement, panes: Pane[], narrow: boolean, tallest = Infinity, most = LARGEST): void {
  const style = getComputedStyle(stage)
  const room = (a: number, ...padding: string[]) => padding.reduce((left, p) => left - parseFloat(p), a) - 1
  const width = room(stage.clientWidth, style.paddingLeft, style.paddingRight)
  const height = room(stage.clientHeight, style.paddingTop, style.paddingBottom)
  const sizes = panes.map((p) => p.size)
  const widest = (of: [number, number][]) => Math.max(...of.map(([w]) => w))
  const sum = (of: number[]) => of.reduce((a, b) => a + b, 0)
  const others = sizes.slice(1)
  const gaps = GAP * (panes.length - 1)
  const row = Math.min((width - gaps) / sum(sizes.map(([w]) => w)), height / Math.max(...sizes.map(([, h]) => h)))
  const beside = others.length < 2 ? 0 : Math.min(
    (width - GAP) / (sizes[0]![0] + widest(others)),
    height / sizes[0]![1],
    (height - GAP * (others.length - 1)) / sum(others.map(([, h]) => h)),
  )
  const one = Math.min(width / widest(sizes), tallest / Math.max(...sizes.map(([, h]) => h)))
  const scale = narrow ? one : Math.max(row, beside)
  stage.classList.toggle('beside', !narrow && beside > row)
  stage.style.setProperty('--scale', String(Math.min(scale, most * PIXELS)))
}

export class Pane {
  readonly root = element('figure', { class: 'pane' })
  svg?: SVGSVGElement
  /** Width and height (mm). */
  size: [number, number] = [1, 1]
  /** The shown part of the plane about the fixed point. */
  private box?: Box
  /** The elements after the definitions. */
  private elements: Element[] = []

  constructor(readonly name: string) {
    this.root.dataset.figure = name
  }

  /** Shows a page, or its changes. With `hold`, the shown part of the plane stays. */
  show(page: Page, hold: boolean): void {
    if (page.delta && this.svg) this.change(page.delta)
    else this.replace(page.svg, hold)
  }

  /** The middle of the fixed point in the document (mm, y down): a pivot on the ground, or the pole. */
  get fixed(): [number, number] {
    const circle = this.svg?.querySelector('circle[id*="-mark-pole"], circle[id*="mechanism-pivot-"]')
    return circle ? [Number(circle.getAttribute('cx') ?? 0), Number(circle.getAttribute('cy') ?? 0)] : [0, 0]
  }

  private replace(text: string, hold: boolean): void {
    const svg = picture(text)
    const [, , width, height] = svg.getAttribute('viewBox')!.split(' ').map(Number) as [number, number, number, number]
    svg.removeAttribute('width')
    svg.removeAttribute('height')
    this.svg?.remove()
    this.root.append(svg)
    this.svg = svg
    this.elements = [...svg.children].filter((e) => !['title', 'desc', 'defs'].includes(e.tagName) && !e.matches('rect.paper'))
    this.fit(width, height, hold)
  }

  private change(delta: Delta): void {
    const svg = this.svg!
    for (const k of delta.removed) this.elements.splice(k, 1)[0]?.remove()
    const texts = [...delta.added, ...delta.changed].map(([, text]) => text)
    const made = parts(texts.join(''))
    delta.added.forEach(([k], n) => {
      svg.insertBefore(made[n]!, this.elements[k] ?? null)
      this.elements.splice(k, 0, made[n]!)
    })
    delta.changed.forEach(([k], n) => {
      const next = made[delta.added.length + n]!
      this.elements[k]!.replaceWith(next)
      this.elements[k] = next
    })
    for (const [k, place] of delta.moved) this.elements[k]!.setAttribute('transform', place)
    if (delta.desc !== null) svg.querySelector('desc')!.textContent = delta.desc
    if (delta.letters !== null) {
      svg.querySelector('defs')?.remove()
      svg.insertBefore(parts(delta.letters)[0]!, this.elements[0] ?? null)
    }
    if (delta.size) this.fit(...delta.size, false)
  }

  private fit(width: number, height: number, hold: boolean): void {
    const svg = this.svg!
    const [x, y] = this.fixed
    const own = { x0: -x, y0: -y, x1: width - x, y1: height - y }
    const old = this.box
    this.box = hold && old
      ? { x0: Math.min(old.x0, own.x0), y0: Math.min(old.y0, own.y0), x1: Math.max(old.x1, own.x1), y1: Math.max(old.y1, own.y1) }
      : own
    const { x0, y0, x1, y1 } = this.box
    svg.setAttribute('viewBox', `${x0 + x} ${y0 + y} ${x1 - x0} ${y1 - y0}`)
    const paper = svg.querySelector('rect.paper')
    for (const [name, value] of [['x', x0 + x], ['y', y0 + y], ['width', x1 - x0], ['height', y1 - y0]] as const) paper?.setAttribute(name, String(value))
    this.size = [x1 - x0, y1 - y0]
    svg.style.setProperty('--mm', String(x1 - x0))
  }
}
