// Tabs with a text of the program: limits and mobility; motion cycle and cams with their figures.

import type { App } from './app'
import { element } from './dom'
import type { Frame, Page } from './engine'
import { word, type Word } from './words'

interface ToldTab {
  /** The report, as the engine names it. */
  of: string
  /** The figure above it. */
  figure?: string
  /** True if one driver must move. */
  moves?: boolean
  /** The tab beside which it is shown. */
  beside?: string
}

export const TOLD: Record<string, ToldTab> = {
  limits: { of: 'limits', moves: true },
  cycle: { of: 'cycle', figure: 'cycle', moves: true },
  least: { of: 'cam', figure: 'cam-alpha', beside: 'cam' },
  mobility: { of: 'mobility' },
}

/** Forms of a motion cycle, and the words for them. */
const FORMS: [string, Word][] = [['bars', 'bars'], ['straight', 'straight'], ['polar', 'rings']]

export class Told {
  /** The allowed pressure angle (degrees), and the form of the motion cycle. */
  private alpha = 30
  private form = 'bars'

  constructor(private site: Pick<App, 'engine' | 'opened' | 'lang' | 'dark' | 'tab'>, private draw: () => void) {}

  /** What a figure of the tabs depends on, for the engine. */
  get choices(): Record<string, unknown> {
    return { alpha: `${this.alpha} deg`, cycle: this.form }
  }

  /** The pages of a tab, what is chosen above them, and the text below. */
  async drawn(tab: string): Promise<{ pages: Page[]; control: HTMLElement | null; below: HTMLElement }> {
    const { of, figure } = TOLD[tab]!
    const { engine, opened, lang, dark } = this.site
    const message = { handle: opened!.handle, lang, ...(dark && { style: 'dark' }), ...(figure && this.choices) }
    const { text } = await engine.ask<{ text: string }>({ do: 'report', of, ...message })
    const frame = figure ? await engine.ask<Frame>({ do: 'frame', what: [figure], prefix: true, ...message }) : null
    return { pages: frame?.figures ?? [], control: this.control(tab), below: element('pre', { class: 'report', tabindex: '0' }, text) }
  }

  private control(tab: string): HTMLElement | null {
    const t = (key: Word) => word(key, this.site.lang)
    if (tab === 'cycle') {
      const select = element('select', { change: () => {
        this.form = select.value
        this.draw()
      } }, ...FORMS.map(([form, key]) => element('option', { value: form, selected: form === this.form }, t(key))))
      return element('label', { class: 'report' }, `${t('form')} `, select)
    }
    if (tab === 'least') {
      const input = element('input', { type: 'number', min: '1', max: '89', step: 'any', value: String(this.alpha), change: () => {
        if (!input.checkValidity() || input.value === '') return
        this.alpha = Number(input.value)
        this.draw()
      } })
      return element('label', { class: 'report' }, `${t('allowed')} [α] = `, input, '°')
    }
    return null
  }
}
