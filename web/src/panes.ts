// The drawings: one pane for each, which keeps its place and size while the mechanism moves.

import { element, picture } from './dom'
import type { Page } from './engine'

interface Box { x0: number; y0: number; x1: number; y1: number }

export class Pane {
  readonly root = element('figure', { class: 'pane' })
  svg?: SVGSVGElement
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
    svg.style.setProperty('--mm', String(width))
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
  }

  /** A point that does not move: a pivot on the ground, or the pole. */
  private fixed(svg: SVGSVGElement): [number, number] {
    const circle = svg.querySelector('circle[id*="-mark-pole"], circle[id*="mechanism-pivot-"]')
    return circle ? [Number(circle.getAttribute('cx') ?? 0), Number(circle.getAttribute('cy') ?? 0)] : [0, 0]
  }
}
