// Files for the user: figures, worksheets, tables, the scene.

import type { App } from './app'
import { element } from './dom'
import { Ended, Refused, type Frame } from './engine'
import { pixels, save } from './share'
import { TOLD } from './told'
import { word, type Word } from './words'

/** The forms by groups: the words for them, the form, and what is asked for in it. */
const GROUPS: [Word, [Word, string, string?][]][] = [
  ['group_figure', [['as_svg', 'svg'], ['as_png', 'png'], ['as_pdf', 'pdf'], ['as_dxf', 'dxf'], ['as_tikz', 'tikz']]],
  ['group_worksheet', [
    ['as_problem_pdf', 'pdf', 'problem'], ['as_solution_pdf', 'pdf', 'solution'], ['as_table_pdf', 'pdf', 'table'],
    ['as_questions_pdf', 'pdf', 'questions'], ['as_frame_pdf', 'pdf', 'frame'], ['as_problem', 'html', 'problem'],
    ['as_solution', 'html', 'solution'], ['as_loops', 'html', 'loops'], ['as_md', 'md'], ['as_typ', 'typ'],
  ]],
  ['group_lesson', [
    ['as_lesson', 'lesson'], ['as_lesson_centres', 'lesson', 'centres'], ['as_lesson_composite', 'lesson', 'composite'],
    ['as_lesson_curvature', 'lesson', 'curvature'], ['as_lesson_cam', 'lesson', 'cam'], ['as_lesson_trains', 'lesson', 'trains'],
    ['as_lesson_loops', 'lesson', 'loops'],
  ]],
  ['group_other', [
    ['as_ggb', 'ggb'], ['as_pylinkage', 'pylinkage'], ['as_pylinkage_json', 'pylinkage-json'], ['as_pmks', 'pmks'],
    ['as_cam_dxf', 'cam-dxf'], ['as_cam_csv', 'cam-csv'],
  ]],
  ['group_data', [['as_csv', 'csv'], ['as_text', 'text'], ['as_json', 'json'], ['as_scene', 'scene']]],
]

/** Steps of the table of a worksheet. */
const STEPS = 12

/** What a message asks for: the sides of a worksheet, its task, or the method of a lesson. */
function details(form: string, of?: string): Record<string, unknown> {
  if (form === 'lesson') return { method: of }
  if (of === 'table') return { sides: 'solution', table: STEPS }
  return of === 'loops' || of === 'questions' || of === 'frame' ? { [of]: true } : { sides: of }
}

export interface SavedFile { name: string; text: string | Uint8Array<ArrayBuffer> }

/** Dots per inch of pictures. */
const DPI = 300

export class Saves {
  constructor(private site: Pick<App, 'engine' | 'editor' | 'opened' | 'lang' | 'tab' | 'travel' | 'name' | 'hint' | 'told'>) {}

  menu(): HTMLElement {
    const { lang } = this.site
    const item = ([key, form, of]: [Word, string, string?]) => element('button', { role: 'menuitem', 'data-form': form + (of ? `-${of}` : ''), click: () => {
      menu.open = false
      void this.export(form, of)
    } }, word(key, lang))
    const groups = GROUPS.map(([key, forms]) => element('div', { role: 'group', 'aria-label': word(key, lang) }, element('h2', {}, word(key, lang)), ...forms.map(item)))
    const menu: HTMLDetailsElement = element('details', { class: 'menu' }, element('summary', {}, word('save', lang)), element('div', { role: 'menu' }, ...groups))
    menu.addEventListener('focusout', (event) => {
      if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false
    })
    return menu
  }

  /** The files of a form; `of` is the side or task of a worksheet, or the method of a lesson. */
  async files(form: string, of?: string): Promise<SavedFile[]> {
    const { opened, engine, editor, name, tab, lang, travel, told } = this.site
    if (form === 'scene') return [{ name: `${name}.json`, text: editor.text }]
    if (!opened) return []
    const { handle } = opened
    const figure = tab in TOLD ? TOLD[tab]!.figure : ['live', 'steps'].includes(tab) ? undefined : tab
    const what = [figure ?? 'sheet']
    const common = { handle, lang, ...told.choices }
    if (form === 'svg') {
      const { figures } = await engine.ask<Frame>({ do: 'frame', what, ...common, ...(travel !== 0 && { travel }) })
      return figures.map((f) => ({ name: `${name}${f.name ? `-${f.name}` : ''}.svg`, text: f.svg }))
    }
    const asked = of || form === 'lesson' ? details(form, of) : form === 'pdf' ? { what, ...(travel !== 0 && { travel }) } : { figure }
    if (form === 'pdf') await engine.giveSong()
    type Made = { name: string; text?: string; base64?: string; pages?: string }
    const { files } = await engine.ask<{ files: Made[] }>({ do: 'export', form, stem: name, ...common, ...asked })
    return Promise.all(files.map(async ({ name, text, base64, pages }) => {
      if (pages !== undefined) return { name, text: await engine.pdf(pages) }
      return { name, text: text ?? Uint8Array.from(atob(base64!), (c) => c.charCodeAt(0)) }
    }))
  }

  private async export(form: string, of?: string): Promise<void> {
    try {
      if (form === 'png') {
        for (const { name, text } of await this.files('svg')) save(name.replace(/svg$/, 'png'), await pixels(String(text), DPI))
        return
      }
      for (const file of await this.files(form, of)) save(file.name, file.text)
    } catch (fault) {
      if (fault instanceof Refused) this.site.hint(fault.diagnostics[0]?.message[this.site.lang] ?? fault.message)
      else if (!(fault instanceof Ended)) throw fault
    }
  }
}
