// The motion: where the driver is, playing it, and dragging it by its grip.

import type { Motion, Pose } from './engine'
import { formula } from './words'

/** The figures that move together in the first tab. */
export const LIVE = ['mechanism', 'velocity', 'acceleration']

export class Course {
  constructor(readonly motion: Motion) {}

  get can(): boolean {
    return this.motion.poses.length > 1
  }

  get low(): number {
    return this.motion.poses[0]?.travel ?? 0
  }

  get high(): number {
    const { poses, full, period } = this.motion
    return full ? this.low + (period ?? 0) : (poses.at(-1)?.travel ?? 0)
  }

  /** A travel brought into the range: around for a full turn, else at its ends. */
  within(travel: number): number {
    const { low, high } = this
    if (!this.motion.full) return Math.min(Math.max(travel, low), high)
    const turn = high - low
    return turn > 0 ? low + ((((travel - low) % turn) + turn) % turn) : low
  }

  /** The place of the grip (mm, y up) at a travel. */
  grip(travel: number): [number, number] | null {
    return this.between(travel, (pose) => pose.grip)
  }

  /** A place that moves, at a travel. */
  private between(travel: number, of: (pose: Pose) => [number, number] | null): [number, number] | null {
    const { poses } = this.motion
    const at = this.within(travel)
    let k = poses.findIndex((p) => p.travel > at)
    if (k < 0) k = poses.length
    const [a, b] = [poses[Math.max(k - 1, 0)], poses[k] ?? (this.motion.full ? poses[0] : poses.at(-1))]
    const [from, to] = [a && of(a), b && of(b)]
    if (!a || !b || !from || !to) return null
    const end = b.travel > a.travel ? b.travel : this.high
    const part = end > a.travel ? (at - a.travel) / (end - a.travel) : 0
    return [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part]
  }

  /** The travel near `from` at which the grip is nearest to a place. */
  nearest(place: [number, number], from: number): number {
    return this.closest(place, from, (travel) => this.grip(travel)) ?? from
  }

  /** The travel near `from` at which a point is nearest to a place (m); null if it has none. */
  nearestOf(point: string, place: [number, number], from: number): number | null {
    const k = this.motion.points?.indexOf(point) ?? -1
    return k < 0 ? null : this.closest(place, from, (travel) => this.between(travel, (pose) => pose.places[k] ?? null))
  }

  private closest(place: [number, number], from: number, where: (travel: number) => [number, number] | null): number | null {
    const { poses } = this.motion
    const span = this.high - this.low
    const reach = span / 5
    const step = span / Math.max(poses.length * 6, 1)
    let best = from
    let least = Infinity
    for (let travel = from - reach; travel <= from + reach; travel += step) {
      const at = where(travel)
      if (!at) return null
      const off = Math.hypot(at[0] - place[0], at[1] - place[1]) + Math.abs(travel - from) * 1e-6
      if (off < least) [best, least] = [travel, off]
    }
    return this.within(best)
  }

  /** The position of the driver in its unit, as a formula. */
  text(travel: number, turns: boolean, name: string): (Node | string)[] {
    const at = this.motion.start + this.within(travel)
    if (this.motion.time) return [formula('t'), ` = ${at.toFixed(3)} s`]
    if (!turns) return [formula(name), ` = ${(at * 1e3).toFixed(1)} mm`]
    const degrees = (at * 180) / Math.PI
    return [formula(name), ` = ${(((degrees % 360) + 360) % 360).toFixed(1)}°`]
  }
}
