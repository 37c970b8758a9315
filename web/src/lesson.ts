// A lesson with the engine inside (`hodograph lesson --live`): its scene, and what is given as fields.

import type { JSONPath } from 'jsonc-parser'
import type { App } from './app'
import { element } from './dom'
import { Draft, difference } from './edits'
import { typed } from './quantities'
import { formula, word } from './words'

const meta = () => document.querySelector<HTMLMetaElement>('meta[name="hodograph-lesson"]')

/** The scene of the lesson; null where the page is none. */
export function lesson(): string | null {
  const content = meta()?.content
  return content === undefined ? null : new TextDecoder().decode(Uint8Array.from(atob(content), (c) => c.charCodeAt(0)))
}

/** Keys of a driver, and the letters of their quantities. */
const DRIVEN: [string, string][] = [['angle', 'phi'], ['omega', 'omega'], ['alpha', 'alpha']]

/** The given values of a scene: their names and places in the text. */
function values(json: any): [string, JSONPath][] {
  const literal = (v: unknown) => typeof v === 'number' || (typeof v === 'string' && /^[-+]?[\d.]/.test(v))
  const all: [string, JSONPath, unknown][] = []
  for (const [name, v] of Object.entries(json?.parameters ?? {})) all.push([name, ['parameters', name], v])
  for (const [name, v] of Object.entries(json?.lengths ?? {})) all.push([`l_${name}`, ['lengths', name], v])
  const many = Array.isArray(json?.driver)
  for (const [n, driver] of (many ? json.driver : json?.driver ? [json.driver] : []).entries()) {
    for (const [key, letter] of DRIVEN) all.push([`${letter}_${driver.link ?? ''}`, many ? ['driver', n, key] : ['driver', key], driver[key]])
  }
  return all.filter(([, , v]) => literal(v)).map(([name, path]) => [name, path])
}

export class Given {
  readonly root = element('section', { class: 'inspector given' })

  constructor(private site: Pick<App, 'editor' | 'engine' | 'lang' | 'hint'>) {
    this.root.hidden = true
  }

  /** Shows the values of the editor's text. */
  show(): void {
    const draft = new Draft(this.site.editor.text)
    const json = draft.at([])
    const focused = this.root.contains(document.activeElement) ? document.activeElement?.id : undefined
    const rows = values(json).map(([name, path]) => {
      const id = `given-${path.join('-')}`
      const field = element('input', { type: 'text', id, value: String(draft.at(path)), spellcheck: 'false', autocomplete: 'off' })
      field.addEventListener('change', () => void this.put(field, path))
      return element('label', { for: id }, element('span', {}, formula(name)), field)
    })
    this.root.replaceChildren(element('h2', {}, word('given', this.site.lang)), ...rows)
    this.root.hidden = !rows.length
    if (focused) document.getElementById(focused)?.focus()
  }

  private async put(field: HTMLInputElement, path: JSONPath): Promise<void> {
    const { editor, engine, hint, lang } = this.site
    const draft = new Draft(editor.text)
    typed({ json: draft.at([]) }, draft, path, field.value)
    const told = await engine.ask<{ values: (number | null)[] }>({ do: 'values', text: draft.text, of: [draft.at(path)] })
    const is = told.values[0] !== null
    field.setAttribute('aria-invalid', String(!is))
    if (!is) return hint.call(this.site, word('no_quantity', lang))
    const edit = difference(editor.text, draft.text)
    if (edit) editor.change(edit)
  }
}
