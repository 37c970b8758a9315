// The drawings: one pane for each, which keeps its place and size while the mechanism moves.

import { element, picture } from './dom'
import type { Page } from './engine'

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
  private box?: Box

  constructor(readonly name: string) {
    this.root.dataset.figure = name
  }

  /** Shows a picture; in motion its fixed point stays where it is. */
  show(page: Page, moving: boolean): void {
    const svg = picture(page.svg)
    svg.removeAttribute('width')
    svg.removeAttribute('height')
    const [, , width, height] = svg.getAttribute('viewBox')!.split(' ').map(Number) as [number, number, number, number]
    this.svg?.remove()
    this.root.append(svg)
    this.svg = svg
    const fixed = this.fixed(svg)
    const box = { x0: -fixed[0], y0: -fixed[1], x1: width - fixed[0], y1: height - fixed[1] }
    const old = this.box
    this.box = moving && old
      ? { x0: Math.min(old.x0, box.x0), y0: Math.min(old.y0, box.y0), x1: Math.max(old.x1, box.x1), y1: Math.max(old.y1, box.y1) }
      : box
    const { x0, y0, x1, y1 } = this.box
    svg.setAttribute('viewBox', `${x0 + fixed[0]} ${y0 + fixed[1]} ${x1 - x0} ${y1 - y0}`)
    this.size = [x1 - x0, y1 - y0]
    svg.style.setProperty('--mm', String(x1 - x0))
  }

  /** A point that does not move: a pivot on the ground, or the pole. */
  private fixed(svg: SVGSVGElement): [number, number] {
    const circle = svg.querySelector('circle[id*="-mark-pole"], circle[id*="mechanism-pivot-"]')
    return circle ? [Number(circle.getAttribute('cx') ?? 0), Number(circle.getAttribute('cy') ?? 0)] : [0, 0]
  }
}
