// Completion and hover from the schema of the file and the names of the scene.

import type { CompletionContext, CompletionResult, Completion } from '@codemirror/autocomplete'
import { syntaxTree } from '@codemirror/language'
import type { EditorState } from '@codemirror/state'
import type { SyntaxNode } from '@lezer/common'
import type { Names } from './engine'

export interface Schema {
  $ref?: string
  $defs?: Record<string, Schema>
  description?: string
  type?: string | string[]
  properties?: Record<string, Schema>
  additionalProperties?: Schema | boolean
  items?: Schema
  enum?: unknown[]
  const?: unknown
  oneOf?: Schema[]
  anyOf?: Schema[]
  allOf?: Schema[]
}

/** The keys from the root of the text to a node; `[]` for an element of a list. */
function path(state: EditorState, node: SyntaxNode | null): string[] {
  const keys: string[] = []
  for (let at = node; at; at = at.parent) {
    if (at.name === 'Property') keys.unshift(name(state, at) ?? '')
    else if (at.parent?.name === 'Array') keys.unshift('[]')
  }
  return keys
}

function name(state: EditorState, property: SyntaxNode): string | null {
  const node = property.getChild('PropertyName')
  if (!node) return null
  return state.sliceDoc(node.from, node.to).replace(/^"|"$/g, '')
}

/** All schemas that may hold of a place. */
function at(root: Schema, keys: string[]): Schema[] {
  let now = open(root, root)
  for (const key of keys) {
    now = now.flatMap((schema) => {
      const next = key === '[]' ? schema.items : (schema.properties?.[key] ?? schema.additionalProperties)
      return next && typeof next === 'object' ? open(next, root) : []
    })
  }
  return now
}

/** A schema without references, by its alternatives. */
function open(schema: Schema, root: Schema, depth = 0): Schema[] {
  if (depth > 8) return []
  const all = [schema]
  if (schema.$ref) {
    const of = root.$defs?.[schema.$ref.replace('#/$defs/', '')]
    if (of) all.push(...open({ ...of, description: schema.description ?? of.description }, root, depth + 1))
  }
  for (const part of [...(schema.oneOf ?? []), ...(schema.anyOf ?? []), ...(schema.allOf ?? [])]) all.push(...open(part, root, depth + 1))
  return all
}

/** The questions that can be asked of the names. */
function questions(names: Names): string[] {
  const points = names.points.flatMap((p) => [`v_${p}`, `a_${p}`, `x_${p}`, `y_${p}`])
  return [...points, ...names.links.flatMap((l) => [`omega_${l}`, `alpha_${l}`, `phi_${l}`])]
}

export function complete(schema: () => Schema | null, names: () => Names | null) {
  return (context: CompletionContext): CompletionResult | null => {
    const root = schema()
    const known = names() ?? { points: [], links: [], parameters: [] }
    const node = syntaxTree(context.state).resolveInner(context.pos, -1)
    const word = context.matchBefore(/"?[\w./ -]*$/)
    const inString = node.name === 'String' || node.name === 'PropertyName'
    if (!root || (!inString && !context.explicit)) return null
    const from = inString ? node.from : (word?.from ?? context.pos)
    const to = inString ? node.to : undefined
    const property = node.name === 'PropertyName' || (node.name === '⚠' && node.parent?.name === 'Object') || node.name === 'Object'
    if (property) {
      const keys = path(context.state, node.name === 'PropertyName' ? (node.parent?.parent ?? null) : node)
      const options: Completion[] = []
      for (const of of at(root, keys)) {
        for (const [key, value] of Object.entries(of.properties ?? {})) {
          options.push({ label: `"${key}"`, type: 'property', info: open(value, root).find((s) => s.description)?.description })
        }
      }
      if (keys[0] === 'lengths') {
        for (const a of known.points) for (const b of known.points) if (a < b) options.push({ label: `"${a}${b}"`, type: 'variable' })
      }
      return options.length ? { from, to, options: unique(options), filter: true } : null
    }
    const keys = path(context.state, node)
    const options: Completion[] = at(root, keys).flatMap((of) => [
      ...(of.enum ?? []).map((v) => ({ label: JSON.stringify(v), type: 'enum' })),
      ...(of.const === undefined ? [] : [{ label: JSON.stringify(of.const), type: 'enum' }]),
    ])
    const own = (list: string[], type: string) => options.push(...list.map((v) => ({ label: `"${v}"`, type })))
    if (keys[0] === 'find') own(questions(known), 'function')
    else {
      own(known.points, 'variable')
      own(known.links, 'class')
      own(known.parameters, 'constant')
    }
    return options.length ? { from, to, options: unique(options), filter: true } : null
  }
}

function unique(all: Completion[]): Completion[] {
  return [...new Map(all.map((c) => [c.label, c])).values()]
}

/** What the schema says of the key at a place. */
export function described(state: EditorState, pos: number, root: Schema | null): { from: number; to: number; text: string } | null {
  const node = syntaxTree(state).resolveInner(pos, 1)
  if (!root || node.name !== 'PropertyName') return null
  const text = at(root, path(state, node.parent)).find((s) => s.description)?.description
  return text ? { from: node.from, to: node.to, text } : null
}
