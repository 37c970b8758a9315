// Changes of the text that leave all other bytes as they are; what is new is written as the file is formatted.

import { findNodeAtLocation, getNodeValue, parseTree, type JSONPath, type Node } from 'jsonc-parser'

/** The keys of a scene in the order in which they are read. */
const ORDER = [
  'title', 'statement', 'parameters', 'units', 'answers', 'links', 'ground', 'points', 'lengths', 'guides', 'gears', 'rolling', 'belts', 'chains',
  'ropes', 'cams', 'driver', 'sketch', 'side', 'find',
]

/** A value in one line. */
export function written(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(written).join(', ')}]`
  if (value !== null && typeof value === 'object') {
    return `{${Object.entries(value).map(([key, v]) => `${JSON.stringify(key)}: ${written(v)}`).join(', ')}}`
  }
  return JSON.stringify(value)
}

export interface Edit { from: number; to: number; insert: string }

/** The one change that makes a text into another. */
export function difference(old: string, now: string): Edit | null {
  if (old === now) return null
  let from = 0
  while (from < old.length && old[from] === now[from]) from++
  let back = 0
  while (back < Math.min(old.length, now.length) - from && old.at(-1 - back) === now.at(-1 - back)) back++
  return { from, to: old.length - back, insert: now.slice(from, now.length - back) }
}

/** A text while it is changed. */
export class Draft {
  constructor(public text: string) {}

  private node(path: JSONPath): Node | undefined {
    const root = parseTree(this.text)
    return root && findNodeAtLocation(root, path)
  }

  at(path: JSONPath): any {
    const node = this.node(path)
    return node && getNodeValue(node)
  }

  private replace(from: number, to: number, by: string): void {
    this.text = this.text.slice(0, from) + by + this.text.slice(to)
  }

  /** Gives a place its value; keys on the way to it are made. */
  put(path: JSONPath, value: unknown): void {
    const node = this.node(path)
    if (node) {
      if (this.text.slice(node.offset, node.offset + node.length) !== written(value)) this.replace(node.offset, node.offset + node.length, written(value))
      return
    }
    const [on, key] = [path.slice(0, -1), path.at(-1)!]
    const parent = this.node(on)
    if (!parent && on.length) this.put(on, typeof key === 'number' ? [value] : { [key]: value })
    else if (parent?.type === 'array') this.insert(parent, written(value))
    else if (parent?.type === 'object') this.insert(parent, `${JSON.stringify(key)}: ${written(value)}`, path.length === 1 ? String(key) : undefined)
  }

  /** Adds an element to a list. */
  push(path: JSONPath, value: unknown): void {
    this.put([...path, this.node(path)?.children?.length ?? 0], value)
  }

  private insert(parent: Node, what: string, key?: string): void {
    const children = parent.children ?? []
    const start = parent.offset + 1
    if (!children.length) {
      this.replace(start, parent.offset + parent.length - 1, key ? `\n  ${what}\n` : what)
      return
    }
    const [first, second] = children as [Node, Node?]
    const between = second && this.text.slice(first.offset + first.length, second.offset).replace(',', '')
    const before = this.text.slice(start, first.offset)
    const space = between ?? (before.includes('\n') ? before : ' ')
    const rank = (name: unknown) => {
      const at = ORDER.indexOf(String(name))
      return at < 0 ? ORDER.length : at
    }
    const after = (key === undefined ? children.length : children.filter((c) => rank(c.children?.[0]?.value) <= rank(key)).length) - 1
    const behind = children[after]
    if (behind) this.replace(behind.offset + behind.length, behind.offset + behind.length, `,${space}${what}`)
    else this.replace(first.offset, first.offset, `${what},${space}`)
  }

  /** Removes a key or an element, and a list or object of the scene that becomes empty with it. */
  drop(path: JSONPath): void {
    let node = this.node(path)
    if (!node) return
    if (node.parent?.type === 'property') node = node.parent
    const siblings = node.parent!.children!
    const k = siblings.indexOf(node)
    if (siblings.length === 1 && path.length === 2 && path[0] !== 'links') this.drop(path.slice(0, 1))
    else if (siblings.length === 1) this.replace(node.parent!.offset + 1, node.parent!.offset + node.parent!.length - 1, '')
    else if (k === 0) this.replace(node.offset, siblings[1]!.offset, '')
    else this.replace(siblings[k - 1]!.offset + siblings[k - 1]!.length, node.offset + node.length, '')
  }

  /** Gives a key another name. */
  renameKey(path: JSONPath, name: string): void {
    const key = this.node(path)?.parent?.children?.[0]
    if (key) this.replace(key.offset, key.offset + key.length, JSON.stringify(name))
  }
}
