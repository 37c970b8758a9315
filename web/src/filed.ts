// The file of `hodograph edit`: read and saved through the server of the page; changes by other editors are followed.

import type { App } from './app'
import { element } from './dom'
import { difference } from './edits'
import { word, type Lang } from './words'

/** Milliseconds between two looks at the file. */
const PAUSE = 700
/** The tag of a file that does not exist. */
const ABSENT = 'none'

const meta = () => document.querySelector<HTMLMetaElement>('meta[name="hodograph-file"]')

/** The language that the command line asks for. */
export const asked = (): Lang | null => (document.querySelector<HTMLMetaElement>('meta[data-lang]')?.dataset.lang || null) as Lang | null

export class Filed {
  /** The file's name; null where the page has no file. */
  readonly name = meta()?.content ?? null
  /** The text of the file as the page last read or saved it, and its tag. */
  private text = ''
  private tag = ABSENT
  /** Its line ends. */
  private returns = false
  /** True while the file is empty or not there, though it had a text. */
  private gone = false
  private asking = false
  private lost = false

  constructor(private site: Pick<App, 'editor' | 'lang' | 'hint' | 'buttons'>) {
    if (this.name === null) return
    window.addEventListener('beforeunload', (event) => this.changed && event.preventDefault())
    document.addEventListener('keydown', (event) => {
      if (event.key !== 's' || !(event.ctrlKey || event.metaKey) || event.shiftKey || event.altKey) return
      event.preventDefault()
      void this.save()
    })
  }

  /** True while the editor has another text than the file. */
  get changed(): boolean {
    return this.name !== null && (this.gone || this.site.editor.text !== this.text)
  }

  /** The first text; empty where the file is new. From here on its changes are followed. */
  async begin(): Promise<string> {
    const response = await fetch('./file')
    await this.take(response)
    const follow = async () => {
      await this.look().catch(() => this.lose())
      setTimeout(follow, PAUSE)
    }
    setTimeout(follow, PAUSE)
    return this.text
  }

  /** Writes the editor's text into the file. */
  async save(): Promise<void> {
    if (this.asking) return
    const text = this.site.editor.text
    try {
      const body = this.returns ? text.replaceAll('\n', '\r\n') : text
      const response = await fetch('./file', { method: 'PUT', headers: { 'If-Match': this.tag }, body })
      if (response.status === 412) return await this.differ(response, true)
      if (!response.ok) return this.site.hint(await this.why(response))
      this.tag = response.headers.get('ETag')!
      this.text = text
      this.gone = false
      this.lost = false
      this.site.hint('')
    } catch {
      this.lose()
    }
    this.site.buttons()
  }

  /** Looks whether another editor has changed the file. */
  private async look(): Promise<void> {
    if (this.asking) return
    const before = this.tag
    const response = await fetch('./file', { headers: { 'If-None-Match': before } })
    if (this.lost) this.site.hint('')
    this.lost = false
    // The page may have saved in the meantime.
    if (response.status !== 200 || this.tag !== before) return
    await this.differ(response, false)
  }

  /** The file has another text than the page knows. */
  private async differ(response: Response, saving: boolean): Promise<void> {
    const before = this.text
    await this.take(response)
    const own = this.site.editor.text
    this.gone = this.text === ''
    if (this.gone) {
      // Some editors empty a file before they write it: what the page has is kept.
      this.text = before
      this.site.buttons()
      return saving ? await this.save() : this.say('gone')
    }
    if (own === before || own === this.text) this.put()
    else if (await this.ask()) this.put()
    else if (saving) await this.save()
    this.site.buttons()
  }

  /** Puts the file's text into the editor; one step of undo leads back. */
  private put(): void {
    const { editor } = this.site
    const edit = difference(editor.text, this.text)
    if (edit) editor.change(edit)
  }

  /** Asks which text is kept; true for the file's. */
  private ask(): Promise<boolean> {
    const { lang } = this.site
    this.asking = true
    return new Promise((resolve) => {
      const dialog = element('dialog', { class: 'asks', 'aria-labelledby': 'asks-what' })
      const answer = (value: string) => () => dialog.close(value)
      dialog.append(
        element('p', { id: 'asks-what' }, element('b', {}, this.name), ' ', word('both_changed', lang)),
        element(
          'div',
          {},
          element('button', { class: 'b-keep', click: answer('own') }, word('keep_own', lang)),
          element('button', { class: 'b-take', click: answer('file') }, word('take_file', lang)),
        ),
      )
      dialog.addEventListener('close', () => {
        dialog.remove()
        this.asking = false
        resolve(dialog.returnValue === 'file')
      })
      document.body.append(dialog)
      dialog.showModal()
    })
  }

  private async take(response: Response): Promise<void> {
    if (!response.ok && response.status !== 412) throw new Error(await this.why(response))
    const text = await response.text()
    this.tag = response.headers.get('ETag')!
    if (text !== '') this.returns = text.includes('\r\n')
    this.text = text.replace(/\r\n?/g, '\n')
  }

  private async why(response: Response): Promise<string> {
    if (response.status !== 500) return `${word('unsaved', this.site.lang)}: ${response.status}`
    return ((await response.json()) as Record<Lang, string>)[this.site.lang]
  }

  private lose(): void {
    // At each look: a drawing empties the line.
    this.lost = true
    this.say('server_gone')
  }

  private say(key: 'gone' | 'server_gone'): void {
    this.site.hint(`${this.name}: ${word(key, this.site.lang)}`)
  }
}
