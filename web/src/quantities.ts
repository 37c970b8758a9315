// Quantities as the text writes them: rounded, in its unit, at the parameter where it has one.

import type { JSONPath } from 'jsonc-parser'
import type { Draft } from './edits'
import type { Outline, XY } from './outline'

const UNITS: Record<string, number> = { mm: 1e-3, cm: 1e-2, m: 1, km: 1e3, in: 0.0254, ft: 0.3048 }
const DEGREE = Math.PI / 180

const tidy = (value: number) => Number(value.toPrecision(12)) + 0
const rounded = (value: number, step: number) => tidy(Math.round(value / step) * step)

/** The unit of lengths in a text: the one that it uses most. */
export function lengthUnit(text: string): string {
  const count: Record<string, number> = {}
  for (const [, unit] of text.matchAll(/\d ?(mm|cm|m|km|in|ft)"/g)) count[unit!] = (count[unit!] ?? 0) + 1
  return Object.entries(count).sort(([, a], [, b]) => b - a)[0]?.[0] ?? 'mm'
}

/** Rounding and writing of new quantities. */
export class Grain {
  /** `step`: the least length (m); `grid`: the distance of the grid's lines (m). */
  constructor(readonly unit: string, readonly step: number, readonly grid: number) {}

  /** For a text that is seen with so many pixels to a metre. */
  static of(text: string, scale: number): Grain {
    const unit = lengthUnit(text)
    const factor = UNITS[unit]!
    // The grid has about twelve pixels, the least length at most two, both a round number of the unit.
    const round = (least: number) => {
      const ten = 10 ** Math.floor(Math.log10(least) + 1e-9)
      return ten * ([1, 2, 5, 10].find((n) => n * ten >= least * 0.999) ?? 10)
    }
    const grid = round(12 / scale / factor) * factor
    return new Grain(unit, 10 ** Math.floor(Math.log10(2 / scale / factor)) * factor, grid)
  }

  snap(at: XY, fine: boolean): XY {
    const to = fine ? this.step : this.grid
    return [rounded(at[0], to), rounded(at[1], to)]
  }

  length(metres: number, unit = this.unit): string {
    return `${tidy(rounded(metres, this.step) / UNITS[unit]!)} ${unit}`
  }

  pair(at: XY): [string | number, string | number] {
    return at.map((v) => (rounded(v, this.step) === 0 ? 0 : this.length(v))) as [string | number, string | number]
  }

  angle(radians: number, step = 1): string {
    return `${rounded(((radians / DEGREE) % 360 + 360) % 360, step) % 360} deg`
  }
}

/** The parameter that a quantity is, if it is nothing else. */
export function parameterOf(outline: Pick<Outline, 'json'>, quantity: unknown): string | null {
  return typeof quantity === 'string' && outline.json.parameters?.[quantity] !== undefined ? quantity : null
}

/** Number of quantities of the text that use a parameter. */
function uses(outline: Outline, name: string): number {
  let count = 0
  const gather = (value: unknown): void => {
    if (typeof value === 'string') count += value.split(/[^\p{L}\p{N}_]+/u).filter((w) => w === name).length
    else if (value !== null && typeof value === 'object') Object.values(value).forEach(gather)
  }
  const { statement: _, title: __, find: ___, links: ____, ...rest } = outline.json
  gather(rest)
  return count
}

/** The place of a quantity, or that of the parameter that it is and that nothing else uses. */
function placeOf(outline: Outline, draft: Draft, path: JSONPath): JSONPath {
  const name = parameterOf(outline, draft.at(path))
  return name !== null && uses(outline, name) === 1 ? ['parameters', name] : path
}

/** Writes a length (m) in the unit that is there. */
export function putLength(outline: Outline, draft: Draft, path: JSONPath, metres: number, grain: Grain): void {
  const to = placeOf(outline, draft, path)
  const old = draft.at(to)
  const unit = typeof old === 'string' ? /^-?[\d.]+ ?(mm|cm|m|km|in|ft)$/.exec(old.trim())?.[1] : undefined
  const bare = outline.json.units?.length
  if (typeof old === 'number' && UNITS[bare]) draft.put(to, tidy(rounded(metres, grain.step) / UNITS[bare]!))
  else if (rounded(metres, grain.step) === 0) draft.put(to, old === 0 ? 0 : `0 ${unit ?? grain.unit}`)
  else draft.put(to, grain.length(metres, unit ?? grain.unit))
}

/** Writes an angle to a tenth of a degree. */
export function putAngle(outline: Outline, draft: Draft, path: JSONPath, radians: number, grain: Grain): void {
  draft.put(placeOf(outline, draft, path), grain.angle(radians, 0.1))
}

/** Text of a quantity in a field: the value of its parameter, or the quantity itself. */
export function shown(outline: Outline, quantity: unknown): string {
  const name = parameterOf(outline, quantity)
  const value = name === null ? quantity : outline.json.parameters[name]
  return typeof value === 'string' || typeof value === 'number' ? String(value) : ''
}

/** The unit of a quantity; empty if it has none. */
const unitOf = (quantity: unknown) => (typeof quantity === 'string' && /^[-+]?[\d.]+ ?([a-zA-Z°][^+*]*)$/.exec(quantity.trim())?.[1]) || ''

/** Writes what was typed; a bare number takes the unit of what it replaces, else the usual one. */
export function typed(outline: Pick<Outline, 'json'>, draft: Draft, path: JSONPath, text: string, usual = ''): void {
  const name = parameterOf(outline, draft.at(path))
  const to: JSONPath = name === null ? path : ['parameters', name]
  const old = draft.at(to)
  const bare = /^-?(\d+\.?\d*|\.\d+)$/.test(text.trim())
  if (!bare) return draft.put(to, text.trim())
  const unit = unitOf(old) || (typeof old === 'number' && outline.json.units !== undefined ? '' : usual)
  draft.put(to, unit ? `${text.trim()} ${unit}` : Number(text))
}
