// The mechanism of a text, which may be incomplete: read from its JSON, without the engine.

import { parseTree, getNodeValue } from 'jsonc-parser'
import type { Engine, Plane } from './engine'

export type XY = [number, number]

export const minus = (a: XY, b: XY): XY => [a[0] - b[0], a[1] - b[1]]
export const plus = (a: XY, b: XY, times = 1): XY => [a[0] + b[0] * times, a[1] + b[1] * times]
export const dot = (a: XY, b: XY) => a[0] * b[0] + a[1] * b[1]
export const left = (a: XY): XY => [-a[1], a[0]]
export const distance = (a: XY, b: XY) => Math.hypot(a[0] - b[0], a[1] - b[1])
export const toward = (angle: number): XY => [Math.cos(angle), Math.sin(angle)]
export const angleOf = (a: XY) => Math.atan2(a[1], a[0])
export const unit = (a: XY): XY => plus([0, 0], a, 1 / (Math.hypot(...a) || 1))

/** The names of which a word such as `AB` or `O2,B` is made; null if it is made of no known ones. */
export function names(text: string, known: Iterable<string>): string[] | null {
  const all = [...known]
  if (/[,-]/.test(text)) {
    const parts = text.split(/[,-]/).map((p) => p.trim())
    return parts.every((p) => all.includes(p)) ? parts : null
  }
  if (text === '') return []
  for (const name of all.filter((n) => text.startsWith(n)).sort((a, b) => b.length - a.length)) {
    const rest = names(text.slice(name.length), all)
    if (rest) return [name, ...rest]
  }
  return null
}

/** In how many ways a word without separators is made of known names. */
function ways(text: string, known: string[]): number {
  return text === '' ? 1 : known.reduce((sum, name) => sum + (text.startsWith(name) ? ways(text.slice(name.length), known) : 0), 0)
}

/** Names in one word as short as it can be read in one way. */
export function joined(parts: string[], known: string[]): string {
  const short = parts.join('')
  return ways(short, known) === 1 ? short : parts.join(',')
}

/** Names in one word. */
export function word(...parts: string[]): string {
  return parts.join(parts.every((p) => p.length === 1) ? '' : ',')
}

/** Lists whose entries name points that are on no link: contacts, and points that move by a law. */
export const NAMING = ['gears', 'rolling', 'cams', 'belts', 'chains', 'ropes', 'motions']
/** The points that an entry of these lists makes. */
export const made = (entry: any): string[] =>
  [entry.at, entry.s === undefined ? undefined : entry.point].flat().filter((name) => typeof name === 'string' && name !== '')

/** A sliding pair, with its place and direction where they are known. */
export interface Guided { k: number; pin?: string; slider?: string; on: string; at?: XY; direction?: XY }
/** The circle of a link: the pitch circle of a gear, a wheel that rolls, the base circle of a cam, a roller. */
export interface Wheel { link: string; centre: string; radius: number; kind: 'gear' | 'wheel' | 'cam' | 'roller' }
/** A straight track, hatched where it is the ground's. */
export interface Track { at: XY; direction: XY; fixed: boolean }

export class Outline {
  /** The whole text; empty where it is no object. */
  readonly json: any
  readonly ground: string | null
  readonly points: string[] = []
  /** The points of each link; sliders that only a guide names have their pin. */
  readonly links = new Map<string, string[]>()
  readonly places = new Map<string, XY>()
  readonly guides: Guided[] = []
  readonly wheels: Wheel[] = []
  readonly tracks: Track[] = []
  /** True if the engine gave the places. */
  solved = false
  /** Links driven to turn. */
  readonly driven: string[]

  private constructor(readonly text: string, private values: Map<string, number>, known: Map<string, XY>, plane: Plane | null) {
    const root = parseTree(text)
    const json = root && root.type === 'object' ? getNodeValue(root) : {}
    this.json = json
    this.ground = typeof json.ground === 'string' ? json.ground : null
    const add = (p: unknown) => typeof p === 'string' && p !== '' && !this.points.includes(p) && this.points.push(p)
    for (const [name, list] of Object.entries(json.links ?? {})) {
      const points = Array.isArray(list) ? list.filter((p): p is string => typeof p === 'string') : []
      points.forEach(add)
      this.links.set(name, points)
    }
    if (this.ground !== null && !this.links.has(this.ground)) this.links.set(this.ground, [])
    for (const guide of this.list('guides')) {
      add(guide.pin)
      if (typeof guide.slider !== 'string') continue
      const own = this.links.get(guide.slider) ?? []
      if (typeof guide.pin === 'string' && !own.includes(guide.pin)) this.links.set(guide.slider, [...own, guide.pin])
      else this.links.set(guide.slider, own)
    }
    for (const p of Object.keys(json.points ?? {})) if (!this.points.includes(p)) add(p)
    this.driven = this.drivers().flatMap((d) => (typeof d.link === 'string' ? [d.link] : []))
    if (plane) {
      this.solved = true
      for (const { name, at } of plane.points) if (at) this.places.set(name, at)
    }
    this.place(known)
    this.pairs()
  }

  /** Reads a text; places come from the engine's solution, else from the text, else from those known before. */
  static async read(text: string, engine: Engine, known = new Map<string, XY>(), plane: Plane | null = null): Promise<Outline> {
    const root = parseTree(text)
    const json = root && root.type === 'object' ? getNodeValue(root) : {}
    const wanted = new Set<string>()
    const gather = (value: unknown): void => {
      if (typeof value === 'string') wanted.add(value)
      else if (value !== null && typeof value === 'object') Object.values(value).forEach(gather)
    }
    for (const key of ['parameters', 'points', 'sketch', 'lengths', 'guides', 'gears', 'rolling', 'cams', 'driver']) gather(json[key])
    if (typeof json.units?.length === 'string') wanted.add(`1 ${json.units.length}`)
    const of = [...wanted]
    // A text that is no JSON has no parameters.
    const told = await engine.ask<{ values: (number | null)[] }>({ do: 'values', text, of })
    const values = new Map<string, number>()
    of.forEach((name, k) => told.values[k] !== null && values.set(name, told.values[k]!))
    return new Outline(text, values, known, plane)
  }

  /** Outline of this text with its mechanism in other places. */
  moved(plane: Plane): Outline {
    return new Outline(this.text, this.values, new Map(), plane)
  }

  list(key: string): any[] {
    return Array.isArray(this.json[key]) ? this.json[key].filter((e: unknown) => e !== null && typeof e === 'object') : []
  }

  drivers(): any[] {
    const one = this.json.driver
    return Array.isArray(one) ? this.list('driver') : one !== null && typeof one === 'object' ? [one] : []
  }

  /** The SI value of a length, an angle or a number in the text. */
  value(quantity: unknown): number | null {
    if (typeof quantity === 'number') return quantity * (this.values.get(`1 ${this.json.units?.length}`) ?? 1)
    return typeof quantity === 'string' ? (this.values.get(quantity) ?? null) : null
  }

  private xy(pair: unknown): XY | null {
    if (!Array.isArray(pair)) return null
    const [x, y] = [this.value(pair[0]), this.value(pair[1])]
    return x === null || y === null ? null : [x, y]
  }

  names(text: unknown): string[] | null {
    return typeof text === 'string' ? names(text, this.points) : null
  }

  /** The given lengths: their keys with the points and the values. */
  lengths(): { key: string; ends: [string, string]; value: number | null }[] {
    return Object.entries(this.json.lengths ?? {}).flatMap(([key, value]) => {
      const ends = this.names(key)
      return ends?.length === 2 ? [{ key, ends: ends as [string, string], value: this.value(value) }] : []
    })
  }

  /** The points that are on no link. */
  unlinked(): string[] {
    return NAMING.flatMap((key) => this.list(key).flatMap(made))
  }

  /** The links that carry a point. */
  carriers(point: string): string[] {
    return [...this.links].filter(([, points]) => points.includes(point)).map(([name]) => name)
  }

  /** The known places of the points of a link. */
  placesOn(link: string): XY[] {
    return (this.links.get(link) ?? []).map((p) => this.places.get(p)).filter((p) => p !== undefined)
  }

  fixed(point: string): boolean {
    return this.ground !== null && (this.links.get(this.ground)?.includes(point) ?? false)
  }

  /** The side on which the text has a point. */
  side(point: string): { left: boolean; line: [string, string]; text: string } | null {
    const text: unknown = this.json.side?.[point]
    const told = typeof text === 'string' ? /^(left|right) of (.+)$/.exec(text) : null
    const line = told && this.names(told[2])
    return line?.length === 2 ? { left: told![1] === 'left', line: line as [string, string], text: told![2]! } : null
  }

  /** The line of a driver or gear: as named, else the first two points of the link. */
  line(link: string, named?: unknown): [string, string] | null {
    const points = this.names(named) ?? this.links.get(link) ?? []
    return points.length >= 2 ? [points[0]!, points[1]!] : null
  }

  private place(known: Map<string, XY>): void {
    const { places, json } = this
    const set = (name: string, at: XY | null) => at && !places.has(name) && places.set(name, at)
    for (const [name, at] of Object.entries(json.points ?? {})) set(name, this.xy(at))
    for (const [name, at] of Object.entries(json.sketch ?? {})) set(name, this.xy(at))
    const lengths = this.lengths()
    const [first] = this.ground === null ? [] : (this.links.get(this.ground) ?? [])
    const axis = lengths.find((l) => l.ends.every((p) => this.fixed(p) && !places.has(p)))
    if (axis?.value && first) {
      const [a, b] = axis.ends[0] === first ? axis.ends : [axis.ends[1], axis.ends[0]]
      set(a, [0, 0])
      set(b, [axis.value, 0])
    }
    for (const p of this.points) set(p, known.get(p) ?? null)
    // All else follows from places in links, driven angles and lengths, as far as it does.
    for (let more = true; more; ) {
      const before = places.size
      for (const [name, at] of Object.entries<any>(json.points ?? {})) set(name, Array.isArray(at) ? null : this.inLink(at))
      for (const driver of this.drivers()) {
        const line = typeof driver.link === 'string' ? this.line(driver.link, driver.line) : null
        const length = line && lengths.find((l) => line.every((p) => l.ends.includes(p)))?.value
        const from = line && places.get(line[0])
        if (from && length) set(line[1], plus(from, toward(this.value(driver.angle) ?? 1), length))
      }
      for (const p of this.points.filter((q) => !places.has(q))) set(p, this.closed(p, lengths) ?? this.onCam(p))
      more = places.size > before
    }
  }

  /** The place of a point in its link. */
  private inLink(at: any): XY | null {
    const base = this.names(at?.base)
    const [a, b] = (base ?? []).map((p) => this.places.get(p))
    if (!a || !b) return null
    const u = unit(minus(b, a))
    const [x, y, length, angle] = [at.x, at.y, at.length, at.angle].map((q) => this.value(q) ?? 0) as [number, number, number, number]
    const [along, across] = at.length === undefined ? [x, y] : [length * Math.cos(angle), length * Math.sin(angle)]
    return plus(plus(a, u, along), left(u), across)
  }

  /** The place of a point by two lengths to known places, on the side that is named. */
  private closed(point: string, lengths: ReturnType<Outline['lengths']>): XY | null {
    const legs = lengths.flatMap(({ ends, value }) => {
      const other = ends[0] === point ? ends[1] : ends[1] === point ? ends[0] : null
      const at = other === null ? null : this.places.get(other)
      return at && value ? [{ at, value }] : []
    })
    const [p, q] = legs
    if (!p || !q) return null
    const between = distance(p.at, q.at)
    if (!between) return null
    const u = unit(minus(q.at, p.at))
    const along = (between ** 2 + p.value ** 2 - q.value ** 2) / (2 * between)
    const across = Math.sqrt(Math.max(p.value ** 2 - along ** 2, 0))
    const [one, other] = [1, -1].map((s) => plus(plus(p.at, u, along), left(u), across * s)) as [XY, XY]
    const side = this.side(point)
    const [a, b] = (side?.line ?? []).map((n) => this.places.get(n))
    const isLeft = a && b ? dot(left(minus(b, a)), minus(one, a)) > 0 : true
    return isLeft === (side?.left ?? true) ? one : other
  }

  /** The place of a roller on the base circle of its cam, in the direction of its guide. */
  private onCam(point: string): XY | null {
    const cam = this.list('cams').find((c) => c.roller?.pin === point)
    const guide = this.list('guides').find((g) => g.pin === point)
    const centre = cam && this.places.get(this.links.get(cam.cam)?.[0] ?? '')
    const reach = cam && (this.value(cam.profile?.base) ?? 0) + (this.value(cam.roller.radius) ?? 0)
    return centre && guide ? plus(centre, toward(this.value(guide.angle) ?? 0), reach) : null
  }

  private pairs(): void {
    this.list('guides').forEach((guide, k) => {
      const on = typeof guide.on === 'string' ? guide.on : this.ground
      if (on === null) return
      const pin = typeof guide.pin === 'string' ? guide.pin : undefined
      const line = this.names(guide.line)
      const [a, b] = (line ?? []).map((p) => this.places.get(p))
      const turned = this.value(guide.angle) ?? 0
      let at = (pin === undefined ? undefined : this.places.get(pin)) ?? this.xy(guide.through) ?? undefined
      let direction: XY | undefined
      if (a && b) direction = toward(angleOf(minus(b, a)) + turned)
      else if (guide.angle !== undefined) direction = toward(turned)
      else if (typeof guide.through === 'string' && at && this.places.has(guide.through)) direction = unit(minus(at, this.places.get(guide.through)!))
      if (typeof guide.slider === 'string' && !at) {
        const own = (this.links.get(guide.slider) ?? []).map((p) => this.places.get(p)).find(Boolean)
        at = own ?? this.rackPlace(guide.slider)
      }
      this.guides.push({ k, pin, slider: typeof guide.slider === 'string' ? guide.slider : undefined, on, at, direction })
    })
    for (const gear of this.list('gears')) {
      const centres = Array.isArray(gear.centres) ? gear.centres : []
      const radii = this.radii(gear)
      centres.forEach((centre: string, n: number) => {
        const link = gear.links?.[n]
        if (radii[n] && typeof link === 'string' && typeof centre === 'string') this.wheels.push({ link, centre, radius: radii[n]!, kind: 'gear' })
      })
    }
    for (const wheel of this.list('rolling')) {
      const radius = this.value(wheel.radius)
      if (!radius || typeof wheel.wheel !== 'string') continue
      this.wheels.push({ link: wheel.wheel, centre: wheel.centre, radius, kind: 'wheel' })
      const [centre, [a, b]] = [this.places.get(wheel.centre), (this.names(wheel.line) ?? []).map((p) => this.places.get(p))]
      const direction = toward((a && b ? angleOf(minus(b, a)) : 0) + (this.value(wheel.angle) ?? 0))
      if (centre && wheel.track === undefined) this.tracks.push({ at: plus(centre, left(direction), -radius), direction, fixed: (wheel.on ?? this.ground) === this.ground })
    }
    for (const cam of this.list('cams')) {
      const base = this.value(cam.profile?.base)
      const centre = this.links.get(cam.cam)?.[0]
      if (base && centre !== undefined) this.wheels.push({ link: cam.cam, centre, radius: base, kind: 'cam' })
      const roller = this.value(cam.roller?.radius)
      if (roller && typeof cam.roller.pin === 'string') this.wheels.push({ link: cam.follower, centre: cam.roller.pin, radius: roller, kind: 'roller' })
    }
  }

  /** The contact of a rack with its wheel. */
  private rackPlace(link: string): XY | undefined {
    const gear = this.list('gears').find((g) => g.rack === link)
    const centre = gear && this.places.get(gear.centres?.[0])
    const radius = gear && this.radii(gear)[0]
    return centre && radius ? plus(centre, left(toward(this.value(gear.angle) ?? 0)), -radius) : undefined
  }

  /** The radii of a pair of gears, as far as they are known. */
  radii(gear: any): (number | null)[] {
    if (Array.isArray(gear.radii)) return gear.radii.map((r: unknown) => this.value(r))
    const teeth: (number | null)[] = Array.isArray(gear.teeth) ? gear.teeth.map((z: unknown) => (typeof z === 'number' ? z : this.value(z))) : []
    const module = this.value(gear.module)
    if (module) return teeth.map((z) => z && (module * z) / 2)
    const [a, b] = (Array.isArray(gear.centres) ? gear.centres : []).map((p: string) => this.places.get(p)) as (XY | undefined)[]
    const [z, y] = teeth
    if (!a || !b || !z || !y) return []
    const sum = gear.ring === undefined ? z + y : Math.abs(z - y)
    return [z, y].map((t) => (distance(a, b) * t) / sum)
  }
}
