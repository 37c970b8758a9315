// Names in a text: renaming one everywhere, and removing what refers to it.

import { getNodePath, parseTree, type JSONPath, type Node } from 'jsonc-parser'
import { Draft } from './edits'
import { joined, made, names, NAMING, type Outline } from './outline'
import type { Grain } from './quantities'

/** Keys whose strings are no names. */
const PROSE = new Set(['title', 'statement', 'parameters', 'units', 'answers', 'paper', 'language', 'notation', 'gravity', 'time'])
/** True if a string of the scene is a question; `key` is true for the key of a member. */
function asks(path: JSONPath, key: boolean): boolean {
  return path[0] === 'composite' || path.slice(0, key ? -1 : undefined).includes(key ? 'printed' : 'find')
}

interface Names { points: string[]; links: string[] }

/** A word with one name exchanged; the same word if the name is not in it. */
function exchanged(text: string, old: string, now: string, of: Names): string {
  if (text === old) return now
  const parts = of.points.includes(old) ? names(text, of.points) : null
  return parts?.includes(old) ? inPlace(text, parts, old, now, of.points) : text
}

/** The names of a word with one exchanged; separators remain. */
function inPlace(text: string, parts: string[], old: string, now: string, all: string[]): string {
  const exchanged = parts.map((p) => (p === old ? now : p))
  const separator = /[,-]/.exec(text)?.[0]
  return separator ? exchanged.join(separator) : joined(exchanged, all.map((n) => (n === old ? now : n)))
}

/** A question with one name exchanged. */
function asked(text: string, old: string, now: string, of: Names): string {
  const all = [...of.points, ...of.links]
  return text.replace(/(\p{L}+_)?([\p{L}\p{N},']+)/gu, (whole, letter: string | undefined, rest: string) => {
    // The ratio of distances from a centre, P24C, has no stroke.
    const cut = letter === undefined && rest.startsWith('P') && names(rest, all) === null ? 1 : 0
    const parts = names(rest.slice(cut), all)
    return parts?.includes(old) ? (letter ?? '') + rest.slice(0, cut) + inPlace(rest.slice(cut), parts, old, now, all) : whole
  })
}

/** A string at its path with one name exchanged. */
function reworded(text: string, path: JSONPath, key: boolean, old: string, now: string, of: Names): string {
  if (path[0] === 'statement') {
    // Values of parameters are in braces.
    const word = (w: string) => (w.startsWith('{') || !of.points.includes(old) ? w : exchanged(w, old, now, of))
    return text.replace(/\$[^$]*\$/g, (formula) => formula.replace(/\{[^}]*\}|[A-Z][A-Z0-9]*/g, word))
  }
  if (PROSE.has(String(path[0])) || (key && path.length !== 2 && !asks(path, true))) return text
  const side = /^(left of |right of )(.+)$/.exec(text)
  if (side) return side[1] + exchanged(side[2]!, old, now, of)
  const plain = exchanged(text, old, now, of)
  return plain === text && asks(path, key) ? asked(text, old, now, of) : plain
}

/** All strings of a text, keys too, with the path of what they are in. */
function strings(text: string): { node: Node; path: JSONPath; key: boolean }[] {
  const all: { node: Node; path: JSONPath; key: boolean }[] = []
  const visit = (node: Node): void => {
    if (node.type === 'string') {
      const key = node.parent?.type === 'property' && node.parent.children![0] === node
      all.push({ node, path: key ? [...getNodePath(node.parent!.parent!), node.value] : getNodePath(node), key })
    }
    node.children?.forEach(visit)
  }
  const root = parseTree(text)
  if (root) visit(root)
  return all
}

const of = (outline: Outline): Names => ({ points: [...outline.points, ...outline.unlinked()], links: [...outline.links.keys()] })

/** True if a name is in use. */
export function taken(outline: Outline, name: string): boolean {
  const { points, links } = of(outline)
  return points.includes(name) || links.includes(name)
}

/** The text with another name for a point or link. */
export function renamed(outline: Outline, old: string, now: string): string {
  let text = outline.text
  for (const { node, path, key } of strings(text).reverse()) {
    const value = reworded(node.value, path, key, old, now, of(outline))
    if (value !== node.value) text = text.slice(0, node.offset) + JSON.stringify(value) + text.slice(node.offset + node.length)
  }
  return text
}

const PROBE = '\u{10ffff}'

/** True if a value of the scene mentions a name. */
function mentions(value: unknown, path: JSONPath, name: string, all: Names): boolean {
  const does = (text: string, at: JSONPath, key: boolean) => reworded(text, at, key, name, PROBE, all) !== text
  if (typeof value === 'string') return does(value, path, false)
  if (value === null || typeof value !== 'object') return false
  return Object.entries(value).some(([k, v]) => (!Array.isArray(value) && does(k, [...path, k], true)) || mentions(v, [...path, k], name, all))
}

/** The keys of the text that still mention a name. */
function remaining(text: string, name: string, all: Names): string[] {
  const found = strings(text).filter(({ node, path, key }) => path[0] !== 'statement' && reworded(node.value, path, key, name, PROBE, all) !== node.value)
  return [...new Set(found.map(({ path }) => String(path[0])))]
}

/** The text without a point or a link and what refers to it; or what must be removed before. */
export function removed(outline: Outline, name: string, kind: 'point' | 'link', grain: Grain): { text: string } | { kept: string[] } {
  const draft = new Draft(outline.text)
  const all = of(outline)
  const gone = new Set<string>([name])
  if (kind === 'point') {
    const placed = Object.entries<any>(outline.json.points ?? {}).filter(([p, at]) => p !== name && outline.names(at?.base)?.includes(name))
    if (placed.length) return { kept: placed.map(([p]) => `points: ${p}`) }
    // A bar without its second end is none.
    for (const [link, points] of outline.links) {
      if (!points.includes(name) || link === outline.ground) continue
      if (points.length <= 2 && (points.length < 2 || !carries(outline, link))) gone.add(link)
    }
  }
  const hit = (v: unknown, ...path: JSONPath) => [...gone].some((n) => mentions(v, path, n, all))
  // With a link go points that are on nothing else, with a guide its block, with a contact its name.
  let left = new Map<string, string[]>()
  for (let before = 0; before !== gone.size; ) {
    before = gone.size
    left = new Map([...outline.links].filter(([link]) => !gone.has(link)).map(([link, points]) => [link, points.filter((p) => !gone.has(p))]))
    const dead = (key: string) => outline.list(key).filter((entry) => hit(entry, key))
    const guides = outline.list('guides').filter((guide) => !hit(guide, 'guides'))
    for (const { slider } of dead('guides')) if (typeof slider === 'string' && outline.json.links?.[slider] === undefined) gone.add(slider)
    for (const entry of NAMING.flatMap(dead)) made(entry).forEach((name) => gone.add(name))
    const runs = (p: string) => guides.filter((g) => g.pin === p)
    for (const p of outline.points) {
      if (![...left.values()].some((points) => points.includes(p)) && !runs(p).some((g) => g.slider !== undefined) && runs(p).length < 2) gone.add(p)
    }
  }
  const together = (...points: string[]) => [...left.values()].some((list) => points.every((p) => list.includes(p)))
  for (const [link, points] of outline.links) {
    if (outline.json.links?.[link] === undefined) continue
    if (gone.has(link)) draft.drop(['links', link])
    else if (points.some((p) => gone.has(p))) draft.put(['links', link], (outline.json.links[link] as string[]).filter((p) => !gone.has(p)))
  }
  for (const { key, ends } of outline.lengths()) if (!together(...ends)) draft.drop(['lengths', key])
  for (const [p, at] of Object.entries<any>(outline.json.points ?? {})) {
    const base = outline.names(at?.base)
    const place = outline.places.get(p)
    if (gone.has(p)) draft.drop(['points', p])
    else if (base && !together(p, ...base)) {
      draft.drop(['points', p])
      if (place) draft.put(['sketch', p], grain.pair(place))
    }
  }
  const json = new Draft(draft.text).at([])
  for (const [key, value] of Object.entries<any>(json)) {
    if (['links', 'lengths', 'points', 'ground'].includes(key) || PROSE.has(key) || value === null || typeof value !== 'object') continue
    if (Array.isArray(value)) for (const [k, one] of [...value.entries()].reverse()) hit(one, key) && draft.drop([key, k])
    else if (key === 'driver' || key === 'balance') hit(value, key) && draft.drop([key])
    else for (const [k, v] of Object.entries(value)) if (hit({ [k]: v }, key)) draft.drop([key, k])
  }
  const kept = [...gone].flatMap((n) => remaining(draft.text, n, all))
  return kept.length ? { kept: [...new Set(kept)] } : { text: draft.text }
}

/** True if a link with one point is something: it carries a guide, or is a wheel or cam. */
function carries(outline: Outline, link: string): boolean {
  return outline.guides.some((g) => g.on === link || g.slider === link) || outline.wheels.some((w) => w.link === link)
}
