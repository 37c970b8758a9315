// The acts of building: each takes an outline and gives another text.

import type { JSONPath } from 'jsonc-parser'
import { Draft } from './edits'
import { angleOf, distance, dot, left, minus, plus, toward, unit, word, type Outline, type XY } from './outline'
import { putAngle, putLength, type Grain } from './quantities'

/** The scene that `New` begins with. */
export const EMPTY = '{\n  "links": {"0": []},\n  "ground": "0"\n}\n'

/** The object under the pointer: a point, a link (at a place of it), or the empty plane. */
export interface Target { at: XY; point?: string; link?: string }

/** An act of several steps on one text. */
export class Act {
  readonly draft: Draft
  private points: Set<string>
  private links: Set<string>
  /** Places of points, with those of new ones. */
  private places: Map<string, XY>
  private own: Map<string, string[]>

  constructor(readonly outline: Outline, readonly grain: Grain) {
    this.draft = new Draft(outline.text)
    if (outline.json.links === undefined) this.draft.put(['links'], {})
    this.points = new Set([...outline.points, ...outline.unlinked()])
    this.links = new Set(outline.links.keys())
    this.places = new Map(outline.places)
    this.own = new Map([...outline.links].map(([name, points]) => [name, [...points]]))
  }

  get text(): string {
    return this.draft.text
  }

  private letter(): string {
    const letters = [...'ABCDEFGHIJKLMNOPQRSTUVWXYZ']
    const name = letters.find((l) => !this.points.has(l)) ?? Array.from({ length: 99 }, (_, k) => `P${k + 1}`).find((l) => !this.points.has(l))!
    this.points.add(name)
    return name
  }

  number(): string {
    let n = 1
    while (this.links.has(String(n))) n++
    this.links.add(String(n))
    return String(n)
  }

  private ground(): string {
    if (this.outline.ground !== null) {
      if (!this.draft.at(['links', this.outline.ground])) this.carry(this.outline.ground)
      return this.outline.ground
    }
    const name = this.links.has('0') ? this.number() : '0'
    this.draft.put(['ground'], name)
    this.carry(name)
    return name
  }

  private carry(link: string, ...points: string[]): void {
    this.own.set(link, [...(this.own.get(link) ?? []), ...points])
    this.draft.put(['links', link], this.own.get(link)!)
  }

  private sketch(point: string, at: XY): void {
    this.draft.put(['sketch', point], this.grain.pair(at))
  }

  /** A point at the target: the one that is there, one on the link there, or a new joint. */
  joint(target: Target): string {
    if (target.point !== undefined) return target.point
    if (target.link !== undefined) return this.onLink(target.link, target.at)
    const name = this.letter()
    this.places.set(name, target.at)
    this.sketch(name, target.at)
    return name
  }

  /** Coordinates that choose the assembly, where the text has none. */
  private keep(point: string): void {
    const at = this.places.get(point)
    if (!at || this.outline.fixed(point) || this.draft.at(['points', point]) || this.draft.at(['sketch', point]) || this.draft.at(['side', point])) return
    this.sketch(point, at)
  }

  /** A pivot on the ground: a new point, or one that is there. */
  pivot(target: Target): string {
    const name = target.point ?? this.letter()
    const ground = this.ground()
    if (!this.own.get(ground)?.includes(name)) this.carry(ground, name)
    if (!this.draft.at(['points', name])) this.draft.put(['points', name], this.grain.pair(target.at))
    this.draft.drop(['sketch', name])
    this.places.set(name, target.at)
    return name
  }

  private length(p: string, q: string): void {
    const [a, b] = [this.places.get(p), this.places.get(q)]
    const there = this.outline.lengths().some(({ ends }) => ends.includes(p) && ends.includes(q))
    if (a && b && !there) this.draft.put(['lengths', word(p, q)], this.grain.length(distance(a, b)))
  }

  /** A link between two targets; its pivot on the ground is named first. */
  link(from: Target, to: Target): { name: string; points: string[] } | null {
    if (from.point !== undefined && from.point === to.point) return null
    let points = [this.joint(from), this.joint(to)]
    if (this.outline.fixed(points[1]!) && !this.outline.fixed(points[0]!)) points = points.reverse()
    const name = this.number()
    this.carry(name, ...points)
    this.length(points[0]!, points[1]!)
    points.forEach((p) => this.keep(p))
    return { name, points }
  }

  /** A link with a third point. */
  extend(link: string, target: Target): string | null {
    const points = this.own.get(link) ?? []
    if (target.point !== undefined && points.includes(target.point)) return null
    const name = this.joint(target.link === link ? { at: target.at } : target)
    this.carry(link, name)
    for (const p of points.slice(0, 2)) this.length(p, name)
    this.keep(name)
    return name
  }

  /** A new point of a link, by its coordinates there. */
  onLink(link: string, at: XY): string {
    const points = this.own.get(link) ?? []
    const name = this.letter()
    this.places.set(name, at)
    const [p, q] = points
    const [a, b] = [p, q].map((n) => (n === undefined ? undefined : this.places.get(n)))
    if (link === this.outline.ground) this.draft.put(['points', name], this.grain.pair(at))
    else if (a && b) {
      const u = unit(minus(b, a))
      const [x, y] = this.grain.pair([dot(minus(at, a), u), dot(minus(at, a), left(u))])
      this.draft.put(['points', name], { base: word(p!, q!), x, y })
    } else {
      this.sketch(name, at)
      if (p !== undefined) this.length(p, name)
    }
    this.carry(link, name)
    return name
  }

  /** A block on a guide of the ground; returns the block's number. */
  groundSlider(target: Target, end: XY): string {
    const ground = this.ground()
    const pin = this.joint(target)
    const at = this.places.get(pin)!
    const angle = this.direction(minus(end, at))
    const slider = this.number()
    const through = (this.own.get(ground) ?? []).find((p) => Array.isArray(this.draft.at(['points', p])) && this.places.has(p))
    const guide: Record<string, unknown> = { pin, slider, on: ground, through: through ?? this.grain.pair(at), angle: this.grain.angle(angle) }
    if (through !== undefined) {
      const offset = dot(minus(at, this.places.get(through)!), left(toward(angle)))
      if (Math.abs(offset) >= this.grain.step / 2) guide.offset = this.grain.length(offset)
    }
    this.draft.push(['guides'], guide)
    this.keep(pin)
    return slider
  }

  /** An angle in steps of 5°, horizontal without a direction. */
  private direction(along: XY): number {
    const step = Math.PI / 36
    return Math.hypot(...along) < this.grain.step ? 0 : Math.round(angleOf(along) / step) * step
  }

  /** A block that runs on a link, or on a new link about a point; returns the block's number. */
  linkSlider(carrier: Target, target: Target): string | null {
    const on = carrier.link ?? this.lone(carrier)
    const points = this.own.get(on) ?? []
    if (target.point !== undefined && points.includes(target.point)) return null
    const pin = this.joint(target.link === on ? { at: target.at } : target)
    const slider = this.number()
    const [a, b] = points
    this.draft.push(['guides'], { pin, slider, on, ...(b === undefined ? { through: a } : { line: word(a!, b) }) })
    // The slot passes through the pin: the sketch shows it so.
    const [from, to, at] = [a, b, pin].map((p) => (p === undefined ? undefined : this.places.get(p)))
    if (from && to && at && this.draft.at(['sketch', b!])) this.sketch(b!, plus(from, unit(minus(at, from)), distance(from, to)))
    this.keep(pin)
    return slider
  }

  /** The link that has this point alone; a new one if there is none. */
  private lone(target: Target): string {
    const point = this.joint(target)
    const there = [...this.own].find(([name, points]) => name !== this.outline.ground && points.length === 1 && points[0] === point)
    if (there) return there[0]
    const name = this.number()
    this.carry(name, point)
    this.keep(point)
    return name
  }

  /** The direction of a track that touches a wheel at a place: the wheel is to its left. */
  private track(centre: XY, contact: XY): { radius: number; angle: number } {
    const from = minus(centre, contact)
    const angle = this.direction([from[1], -from[0]])
    return { radius: Math.max(dot(from, left(toward(angle))), this.grain.step), angle }
  }

  /** A wheel that rolls on a line of the ground or of a link. */
  wheel(centre: Target, contact: Target): string {
    const link = centre.link ?? this.lone(centre)
    const point = this.centre(link, centre)
    const { radius, angle } = this.track(this.places.get(point)!, contact.at)
    const wheel: Record<string, unknown> = { wheel: link, centre: point, radius: this.grain.length(radius) }
    const line = contact.link === undefined || contact.link === this.outline.ground ? null : this.outline.line(contact.link)
    if (line) Object.assign(wheel, { on: contact.link, line: word(...line) })
    else Object.assign(wheel, { through: this.grain.pair(plus(this.places.get(point)!, left(toward(angle)), -radius)), angle: this.grain.angle(angle) })
    this.draft.push(['rolling'], wheel)
    return link
  }

  /** The centre of a gear on a link: of its pivots on other links the nearest. */
  private centre(link: string, target: Target): string {
    const points = this.own.get(link) ?? []
    const shared = points.filter((p) => [...this.own].some(([name, others]) => name !== link && others.includes(p)))
    const fixed = shared.filter((p) => this.outline.fixed(p))
    const of = fixed.length ? fixed : shared.length ? shared : points
    const off = (p: string) => distance(this.places.get(p) ?? [Infinity, 0], target.at)
    return of.reduce((best, p) => (off(p) < off(best) ? p : best), of[0]!)
  }

  /** Two gears in mesh, with as many teeth. */
  gears(one: Target, other: Target): string | null {
    const links = [one, other].map((t) => t.link ?? this.lone(t)) as [string, string]
    if (links[0] === links[1]) return null
    const centres = links.map((link, k) => this.centre(link, [one, other][k]!)) as [string, string]
    if (centres[0] === centres[1]) return null
    const gear: Record<string, unknown> = { links, centres, teeth: [20, 20] }
    const [a, b] = centres.map((p) => this.places.get(p)) as [XY, XY]
    const lines = links.map((link) => this.own.get(link)!.slice(0, 2).map((p) => this.places.get(p))) as (XY | undefined)[][]
    const turned = lines.map(([p, q]) => (p && q ? angleOf(minus(q, p)) - angleOf(minus(b, a)) : null))
    if (turned[1] !== null && turned[1] !== undefined) gear.phase = this.grain.angle(turned[1] + (turned[0] ?? 0))
    this.draft.push(['gears'], gear)
    return links[1]
  }

  /** A rack that a gear drives along the ground. */
  rack(wheel: Target, contact: Target): string {
    const link = wheel.link ?? this.lone(wheel)
    const centre = this.centre(link, wheel)
    const { radius, angle } = this.track(this.places.get(centre)!, contact.at)
    const rack = this.number()
    const ground = this.ground()
    this.draft.push(['guides'], { slider: rack, on: ground, through: this.grain.pair(contact.at), angle: this.grain.angle(angle) })
    this.draft.push(['gears'], { links: [link, rack], centres: [centre], radii: [this.grain.length(radius)], rack, angle: this.grain.angle(angle) })
    return rack
  }

  /** A cam about a pivot, by a law, with a roller on a guide of the ground. */
  cam(pivot: Target, follower: XY): string {
    const centre = this.pivot(pivot)
    const at = this.places.get(centre)!
    const cam = this.number()
    this.carry(cam, centre)
    const slider = this.number()
    const pin = this.letter()
    const reach = Math.max(distance(at, follower), 8 * this.grain.step)
    const size = (part: number) => this.grain.length(Math.max(Math.round((reach * part) / this.grain.step / 2) * 2, 2) * this.grain.step)
    const angle = this.grain.angle(this.direction(minus(follower, at)))
    this.draft.push(['guides'], { pin, slider, on: this.ground(), through: centre, angle })
    this.carry(slider, pin)
    this.draft.push(['cams'], {
      cam, follower: slider, roller: { pin, radius: size(0.2) },
      profile: { base: size(0.6), law: [
        { rise: size(0.4), over: '120 deg', law: 'cycloidal' }, { dwell: '60 deg' }, { return: size(0.4), over: '120 deg', law: 'cycloidal' }, { dwell: '60 deg' },
      ] },
    })
    return cam
  }

  /** A driver: of a slider along its guide, else of a link that turns; returns what it drives. */
  driver(target: Target): { kind: 'point' | 'link'; name: string } | null {
    const { outline } = this
    const block = outline.guides.find((g) => (target.point !== undefined ? g.pin === target.point : g.slider === target.link) && g.slider !== undefined)
    let made: Record<string, unknown>
    if (block && block.on === outline.ground) {
      const guide = outline.list('guides')[block.k]
      const start = (typeof guide.through === 'string' ? outline.places.get(guide.through) : undefined)
        ?? (Array.isArray(guide.through) ? guide.through.map((q: unknown) => outline.value(q) ?? 0) as XY : undefined)
      const position = start && block.at && block.direction ? dot(minus(block.at, start), block.direction) : 0
      made = { slide: block.pin ?? block.slider, ...(block.pin === undefined ? {} : { position: this.grain.length(position) }), velocity: '1 m/s' }
    } else {
      const link = target.link ?? this.turning(target.point)
      if (link === null) return null
      if (outline.driven.includes(link)) return { kind: 'link', name: link }
      const line = outline.line(link)?.map((p) => outline.places.get(p))
      // A wheel or cam has no line: any angle will do.
      const angle = line?.[0] && line[1] ? angleOf(minus(line[1], line[0])) : Math.PI / 6
      made = { link, angle: this.grain.angle(angle), omega: '10 rad/s' }
    }
    const old = this.draft.at(['driver'])
    if (old === undefined) this.draft.put(['driver'], made)
    else if (Array.isArray(old)) this.draft.push(['driver'], made)
    else this.draft.put(['driver'], [old, made])
    return { kind: made.slide !== undefined && made.slide === block?.pin ? 'point' : 'link', name: String(made.slide ?? made.link) }
  }

  /** The link about the ground at whose end a point is. */
  private turning(point?: string): string | null {
    if (point === undefined) return null
    const all = this.outline.carriers(point).filter((l) => l !== this.outline.ground)
    return all.find((l) => this.own.get(l)!.some((p) => this.outline.fixed(p))) ?? all[0] ?? null
  }

  /** Asks for a quantity, or no longer. */
  ask(find: string): void {
    const list: unknown = this.draft.at(['find'])
    const k = Array.isArray(list) ? list.indexOf(find) : -1
    if (k >= 0) this.draft.drop(['find', k])
    else this.draft.push(['find'], find)
  }

  /** Moves a joint; all others stay where they are. Null if the text has nothing that places it. */
  move(point: string, to: XY): XY | null {
    const { outline, draft, grain } = this
    const from = outline.places.get(point)
    if (!from) return null
    const at = this.allowed(point, from, to)
    if (!at) return null
    const before = draft.text
    const length = (path: JSONPath, metres: number) => putLength(outline, draft, path, metres, grain)
    for (const { key, ends } of outline.lengths()) {
      const other = ends[0] === point ? ends[1] : ends[1] === point ? ends[0] : null
      const place = other === null ? undefined : outline.places.get(other)
      if (place) length(['lengths', key], distance(at, place))
    }
    const own = draft.at(['points', point])
    if (Array.isArray(own)) [0, 1].forEach((k) => length(['points', point, k], at[k]!))
    else if (own) this.moveInLink(point, own, at)
    if (draft.at(['sketch', point])) [0, 1].forEach((k) => length(['sketch', point, k], at[k]!))
    this.moveGuide(point, from, at)
    this.movePins(point, from, at)
    this.turn(point, at)
    this.sides(point, at)
    return draft.text === before && distance(from, at) >= grain.step ? null : at
  }

  /** The place nearest to the wanted one that the text can say; null if it can say no other. */
  private allowed(point: string, from: XY, to: XY): XY | null {
    const { outline } = this
    const meshed = outline.list('gears').some((g) => (g.radii ?? g.module) !== undefined && g.centres?.length === 2 && g.centres.includes(point))
    if (meshed) return null
    if (outline.fixed(point) && outline.json.points?.[point] === undefined) {
      // Two pivots with a length: the first is the origin, the other is on the axis.
      const other = outline.links.get(outline.ground!)!.indexOf(point) > 0
      const axis = outline.lengths().some(({ ends }) => ends.includes(point) && ends.every((p) => outline.fixed(p)))
      return other && axis ? [to[0], from[1]] : null
    }
    const guide = outline.guides.find((g) => g.pin === point && g.on === outline.ground && g.direction)
    const entry = guide && outline.list('guides')[guide.k]
    // A line through a point, without an offset, stays.
    if (!guide || entry.offset !== undefined || Array.isArray(entry.through) || entry.through === undefined) return to
    return plus(from, guide.direction!, dot(minus(to, from), guide.direction!))
  }

  private moveInLink(point: string, own: any, at: XY): void {
    const { outline, draft, grain } = this
    const [a, b] = (outline.names(own.base) ?? []).map((p) => outline.places.get(p))
    if (!a || !b) return
    const u = unit(minus(b, a))
    const local: XY = [dot(minus(at, a), u), dot(minus(at, a), left(u))]
    if (own.length === undefined) {
      putLength(outline, draft, ['points', point, 'x'], local[0], grain)
      putLength(outline, draft, ['points', point, 'y'], local[1], grain)
    } else {
      putLength(outline, draft, ['points', point, 'length'], Math.hypot(...local), grain)
      putAngle(outline, draft, ['points', point, 'angle'], angleOf(local), grain)
    }
  }

  private moveGuide(point: string, from: XY, at: XY): void {
    const { outline, draft, grain } = this
    for (const guide of outline.guides) {
      if (guide.pin !== point || guide.on !== outline.ground || !guide.direction) continue
      const entry = outline.list('guides')[guide.k]
      const off = dot(minus(at, from), left(guide.direction))
      if (Math.abs(off) < grain.step / 2) continue
      if (entry.offset !== undefined) putLength(outline, draft, ['guides', guide.k, 'offset'], (outline.value(entry.offset) ?? 0) + off, grain)
      else if (Array.isArray(entry.through)) [0, 1].forEach((k) => putLength(outline, draft, ['guides', guide.k, 'through', k], at[k]!, grain))
    }
  }

  /** Pins with coordinates on guides of the ground through a moved point: they stay on their lines. */
  private movePins(point: string, from: XY, at: XY): void {
    const { outline, draft, grain } = this
    for (const { k, pin, on, direction } of outline.guides) {
      const place = pin === undefined ? undefined : outline.places.get(pin)
      if (!place || !direction || on !== outline.ground || outline.list('guides')[k].through !== point || !Array.isArray(draft.at(['points', pin!]))) continue
      const across = left(direction)
      const moved = plus(place, across, dot(minus(at, from), across))
      ;[0, 1].forEach((n) => putLength(outline, draft, ['points', pin!, n], moved[n]!, grain))
    }
  }

  /** Drivers and phases with a line that ends in a moved point: its angle follows, so that the others stay. */
  private turn(point: string, at: XY): void {
    const { outline, draft, grain } = this
    const turned = (line: [string, string] | null): number => {
      if (!line?.includes(point)) return 0
      const old = line.map((p) => outline.places.get(p))
      const now = line.map((p, k) => (p === point ? at : old[k]))
      return old[0] && old[1] ? angleOf(minus(now[1]!, now[0]!)) - angleOf(minus(old[1], old[0])) : 0
    }
    const list = Array.isArray(outline.json.driver)
    outline.drivers().forEach((driver, k) => {
      const path: JSONPath = list ? ['driver', k] : ['driver']
      const by = turned(typeof driver.link === 'string' ? outline.line(driver.link, driver.line) : null)
      const angle = outline.value(driver.angle)
      if (by && angle !== null) putAngle(outline, draft, [...path, 'angle'], angle + by, grain)
      const guide = outline.guides.find((g) => g.pin === point && driver.slide === point)
      const position = outline.value(driver.position)
      if (guide?.direction && position !== null) putLength(outline, draft, [...path, 'position'], position + dot(minus(at, outline.places.get(point)!), guide.direction), grain)
    })
    outline.list('gears').forEach((gear, k) => {
      const phase = outline.value(gear.phase)
      const [r, s] = outline.radii(gear)
      if (phase === null || !r || !s) return
      const [one, other] = [0, 1].map((n) => turned(outline.line(gear.links?.[n]))) as [number, number]
      const by = other + ((gear.ring === undefined ? 1 : -1) * one * r) / s
      if (by) putAngle(outline, draft, ['gears', k, 'phase'], phase + by, grain)
    })
  }

  /** Sides that change with a moved point. */
  private sides(point: string, at: XY): void {
    const { outline } = this
    const now = new Map(outline.places).set(point, at)
    for (const name of Object.keys(outline.json.side ?? {})) {
      const told = outline.side(name)
      if (!told || ![name, ...told.line].includes(point)) continue
      const side = (places: Map<string, XY>) => {
        const [p, a, b] = [name, ...told.line].map((n) => places.get(n))
        return p && a && b ? Math.sign(dot(left(minus(b, a)), minus(p, a))) : 0
      }
      if (side(outline.places) * side(now) < 0) this.draft.put(['side', name], `${told.left ? 'right' : 'left'} of ${told.text}`)
    }
  }
}
