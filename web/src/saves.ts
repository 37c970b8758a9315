// Files for the user: figures, worksheets, tables, the scene.

import type { App } from './app'
import { element } from './dom'
import { Ended, Refused, type Frame } from './engine'
import { pixels, save } from './share'
import { word, type Word } from './words'

const FORMS: [Word, string, string?][] = [
  ['as_svg', 'svg'], ['as_png', 'png'], ['as_pdf', 'pdf'], ['as_problem_pdf', 'pdf', 'problem'], ['as_solution_pdf', 'pdf', 'solution'], ['as_problem', 'html', 'problem'], ['as_solution', 'html', 'solution'], ['as_loops', 'html', 'loops'], ['as_md', 'md'], ['as_typ', 'typ'],
  ['as_lesson', 'lesson'], ['as_csv', 'csv'], ['as_text', 'text'], ['as_json', 'json'], ['as_scene', 'scene'],
]

export interface SavedFile { name: string; text: string | Uint8Array<ArrayBuffer> }

/** Dots per inch of pictures. */
const DPI = 300

export class Saves {
  constructor(private site: Pick<App, 'engine' | 'editor' | 'opened' | 'lang' | 'tab' | 'travel' | 'name' | 'hint'>) {}

  menu(): HTMLElement {
    const { lang } = this.site
    const list = FORMS.map(([key, form, sides]) => element('button', { role: 'menuitem', 'data-form': form + (sides ? `-${sides}` : ''), click: () => {
      menu.open = false
      void this.export(form, sides)
    } }, word(key, lang)))
    const menu: HTMLDetailsElement = element('details', { class: 'menu' }, element('summary', {}, word('save', lang)), element('div', { role: 'menu' }, ...list))
    menu.addEventListener('focusout', (event) => {
      if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false
    })
    return menu
  }

  /** The files of a form. */
  async files(form: string, sides?: string): Promise<SavedFile[]> {
    const { opened, engine, editor, name, tab, lang, travel } = this.site
    if (form === 'scene') return [{ name: `${name}.json`, text: editor.text }]
    if (!opened) return []
    const { handle } = opened
    const what = ['live', 'steps', 'limits', 'mobility'].includes(tab) ? ['sheet'] : [tab]
    if (form === 'pdf') {
      const message: Record<string, unknown> = { do: 'export', handle, form, stem: name, lang }
      if (sides) message.sides = sides
      else Object.assign(message, { what }, travel !== 0 && { travel })
      await engine.giveSong()
      const { files } = await engine.ask<{ files: { name: string; pages: string }[] }>(message)
      return Promise.all(files.map(async (file) => ({ name: file.name, text: await engine.pdf(file.pages) })))
    }
    if (form === 'svg') {
      const message: Record<string, unknown> = { do: 'frame', handle, what, lang }
      if (travel !== 0) message.travel = travel
      const { figures } = await engine.ask<Frame>(message)
      return figures.map((f) => ({ name: `${name}${f.name ? `-${f.name}` : ''}.svg`, text: f.svg }))
    }
    const asked = sides === 'loops' ? { loops: true } : { sides }
    const { files } = await engine.ask<{ files: SavedFile[] }>({ do: 'export', handle, form, ...asked, stem: name, lang })
    return files
  }

  private async export(form: string, sides?: string): Promise<void> {
    try {
      if (form === 'png') {
        for (const { name, text } of await this.files('svg')) save(name.replace(/svg$/, 'png'), await pixels(String(text), DPI))
        return
      }
      for (const file of await this.files(form, sides)) save(file.name, file.text)
    } catch (fault) {
      if (fault instanceof Refused) this.site.hint(fault.diagnostics[0]?.message[this.site.lang] ?? fault.message)
      else if (!(fault instanceof Ended)) throw fault
    }
  }
}
