// The page: text, engine, drawings, and what the user does with them. The text is the only state that lasts.

import { Answers } from './answers'
import { Builder } from './build'
import { element } from './dom'
import { Editor } from './editor'
import { Ended, Engine, Refused, type Diagnostic, type Frame, type Motion, type Names, type Opened, type Page } from './engine'
import type { Schema } from './complete'
import { asked, Filed } from './filed'
import { Gallery } from './gallery'
import { Given, lesson } from './lesson'
import { Course, LIVE } from './motion'
import { arrange, Pane } from './panes'
import { Saves } from './saves'
import { fragment, shared } from './share'
import { TOLD, Told } from './told'
import { isWord, word, type Lang, type Word } from './words'

/** Tabs of single figures, each shown if the file calls for it. */
const SINGLE = [
  'sheet', 'equations', 'results', 'centres', 'loops', 'composite', 'curvature', 'centrodes', 'forces', 'lever', 'gears', 'kutzbach',
  'cam', 'cam-instant', 'replaced', 'attempts', 'groups', 'plates', 'inversions', 'cognates', 'curves',
]
/** Figures that take long: drawn when their tab is chosen. */
const SLOW = ['curves']
/** The first template. */
const FIRST = 'shaper'
/** Largest text that is taken for a scene. */
const LARGEST = 1 << 20
/** Seconds of a turn while the mechanism plays. */
const TURN = 8

export class App {
  readonly engine = new Engine()
  readonly editor: Editor
  /** The file in the engine; null before the first, and after the engine was ended. */
  opened: Opened | null = null
  tab = 'live'
  travel = 0
  course: Course | null = null
  lang: Lang = asked() ?? (localStorage.getItem('lang') as Lang | null) ?? (navigator.language.startsWith('zh') ? 'zh' : 'en')
  dark = localStorage.getItem('theme') ? localStorage.getItem('theme') === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches
  private schemas: Record<string, Schema> | null = null
  private panes = new Map<string, Pane>()
  private pages = new Map<string, Page[]>()
  private steps: Page[] | null = null
  private stepAt = 0
  private absent = new Set<string>()
  name = FIRST
  /** The text of the opened file. */
  private read = ''
  /** The names of the text, as far as it can be read. */
  private names: Names | null = null
  private playing = false
  private wanted = false
  private drawing = false
  /** True while the panes show moving figures, whose changes the engine knows. */
  private moving = false
  /** True while the next drawing is of the same mechanism. */
  private hold = false
  private generation = 0
  private timer = 0
  private given = new Given(this)
  readonly told = new Told(this, () => void this.draw(false))
  private saves = new Saves(this)
  private filed: Filed
  private builder: Builder
  private gallery = new Gallery((name) => void this.template(name))

  private bar = element('header', { class: 'bar' })
  private tabs = element('nav', { class: 'tabs', role: 'tablist' })
  private stage = element('div', { class: 'stage', role: 'tabpanel' })
  private note = element('p', { class: 'note', role: 'status', 'aria-live': 'polite' })
  private transport = element('div', { class: 'transport' })
  private slider = element('input', { type: 'range', min: '0', max: '1', step: 'any' })
  private reading = element('output', { class: 'reading' })
  private answers = new Answers()
  private faults = element('ul', { class: 'faults' })
  private text = element('div', { class: 'text' })
  private title = element('span', { class: 'title' })

  constructor(root: HTMLElement) {
    this.builder = new Builder(this)
    root.append(
      this.bar,
      element('main', { class: 'work' }, this.tabs, this.stage, this.builder.root, this.note, this.transport),
      element('aside', { class: 'side' }, this.given.root, this.answers.root, this.faults, this.text),
    )
    this.editor = new Editor({
      parent: this.text,
      label: 'JSON',
      schema: () => this.schemas?.[this.opened?.kind ?? 'scene'] ?? null,
      names: () => this.names,
      changed: (atOnce) => this.changed(atOnce),
    })
    this.filed = new Filed(this)
    this.engine.onBusy = (busy) => document.body.classList.toggle('busy', busy)
    this.engine.onEnd = (trap) => {
      this.opened = null
      if (trap !== null) console.warn(trap)
      this.say(trap === null ? 'cancelled' : 'trapped')
    }
    this.slider.addEventListener('input', () => this.go(Number(this.slider.value)))
    this.slider.addEventListener('change', () => void this.settle())
    this.stage.addEventListener('pointerdown', (event) => this.grab(event))
    document.addEventListener('keydown', (event) => this.key(event))
    new ResizeObserver(() => this.arrange()).observe(this.stage)
    this.dropping()
    this.dress()
  }

  async start(): Promise<void> {
    let text: string | null = null
    try {
      text = await shared(location.hash)
    } catch {
      this.say('unreadable')
    }
    window.addEventListener('hashchange', () => void shared(location.hash).then((t) => t !== null && t !== this.editor.text && this.begin(t, 'scene'), () => this.say('unreadable')))
    const taught = lesson()
    if (taught !== null) {
      document.body.classList.add('lesson')
      this.tab = 'steps'
      this.begin(taught, 'scene')
    } else if (this.filed.name !== null) {
      const text = await this.filed.begin()
      if (text === '') this.create()
      else this.begin(text, '')
      this.name = this.filed.name.replace(/\.json$/, '')
    } else if (text !== null) this.begin(text, 'scene')
    else await this.template(FIRST)
    this.schemas = await this.engine.ask<Record<string, Schema>>({ do: 'schema' }).catch(() => null)
  }

  /** Begins with a template. */
  async template(name: string): Promise<void> {
    const { text } = await this.engine.ask<{ text: string }>({ do: 'template', name })
    history.replaceState(null, '', location.pathname + location.search)
    this.begin(text, name)
  }

  /** Begins with a text; `name` is the stem of its files. */
  private begin(text: string, name: string): void {
    this.name = name
    this.hold = false
    this.stepAt = 0
    this.answers.forget()
    this.editor.begin(text)
  }

  // --- The text, and what the engine says of it ---

  private changed(atOnce: boolean): void {
    clearTimeout(this.timer)
    this.buttons()
    this.timer = window.setTimeout(() => void this.open(), atOnce ? 0 : 300)
  }

  /** Reads the text anew and draws it. */
  async open(): Promise<void> {
    const generation = ++this.generation
    const text = this.editor.text
    this.pause()
    if (document.body.classList.contains('lesson')) this.given.show()
    try {
      const opened = await this.engine.ask<Opened>({ do: 'open', text, lang: this.lang })
      if (generation !== this.generation) {
        void this.engine.ask({ do: 'close', handle: opened.handle }).catch(() => {})
        return
      }
      if (this.opened) void this.engine.ask({ do: 'close', handle: this.opened.handle }).catch(() => {})
      this.opened = opened
      this.read = text
      this.names = opened.names
      this.travel = 0
      this.course = null
      this.pages.clear()
      this.steps = null
      this.absent.clear()
      this.stage.classList.remove('stale')
      this.title.textContent = opened.title
      document.title = opened.title ? `${opened.title} · hodograph` : 'hodograph'
      this.tell(opened.diagnostics)
      if (opened.kind !== 'scene') this.tab = 'sheet'
      if (opened.kind === 'scene' && this.tab !== 'live' && this.tab !== 'steps' && this.tab !== 'sheet') this.tab = 'live'
      this.dressTabs()
      await this.draw(false)
      this.hold = true
      this.dressTransport()
      void this.idle(generation)
    } catch (fault) {
      if (generation !== this.generation) return
      if (!(fault instanceof Refused || fault instanceof Ended)) throw fault
      this.stage.classList.add('stale')
      if (fault instanceof Refused) {
        this.names = fault.names
        this.tell(fault.diagnostics, !this.builder.on)
      }
      // Nothing else is there to be seen.
      if (!this.opened && !this.builder.on && text.includes('"links"')) this.builder.open(true)
      await this.unsolved()
    }
  }

  /** While building, a text that is refused is shown as a sketch. */
  private async unsolved(): Promise<void> {
    if (!this.builder.on) return
    this.course = null
    this.answers.root.hidden = true
    this.title.textContent = ''
    this.dressTransport()
    await this.builder.refused().catch(ended)
  }

  /** Follows the motion, then tries which figures there are, while nothing else is asked. */
  private async idle(generation: number): Promise<void> {
    const here = () => generation === this.generation && this.opened !== null
    const ask = <T>(message: Record<string, unknown>) => this.engine.ask<T>({ handle: this.opened!.handle, lang: this.lang, ...message })
    try {
      if (here() && this.opened!.swept !== null) {
        const motion = await ask<Motion>({ do: 'motion' })
        if (!here()) return
        this.course = new Course(motion)
        this.dressTransport()
        this.dressTabs()
        // The figures with space for the whole motion, before anything moves.
        if (this.tab === 'live' && this.course.can && !this.builder.on) await this.draw(true)
      }
      for (const name of this.opened?.kind === 'scene' ? SINGLE : []) {
        while (here() && (this.playing || this.wanted || this.engine.busy)) await new Promise((r) => setTimeout(r, 200))
        if (!here()) return
        if (this.pages.has(name) || this.absent.has(name) || SLOW.includes(name)) continue
        await this.single(name).catch(() => this.absent.add(name))
        if (here()) this.dressTabs()
      }
    } catch (fault) {
      if (!(fault instanceof Ended) && !(fault instanceof Refused)) throw fault
    }
  }

  /** The pages of a single figure in the pose of the text. */
  private async single(name: string): Promise<Page[]> {
    const known = this.pages.get(name)
    if (known) return known
    const generation = this.generation
    const frame = await this.frame([name], null, false)
    if (generation === this.generation) {
      if (frame.figures.length) this.pages.set(name, frame.figures)
      else this.absent.add(name)
    }
    return frame.figures
  }

  /** Figures in the pose of the text, or after a travel: then their changes since the last travel. */
  private frame(what: string[], travel: number | null, answers: boolean): Promise<Frame> {
    const message: Record<string, unknown> = { do: 'frame', handle: this.opened!.handle, what, lang: this.lang, answers, prefix: true, plane: this.builder.on, mu: this.builder.mu }
    if (this.dark) message.style = 'dark'
    if (travel === null || this.builder.on) {
      this.moving = false
      return this.engine.ask<Frame>(travel === null ? message : { ...message, travel })
    }
    const whole = !this.moving
    this.moving = true
    return this.engine.ask<Frame>({ ...message, do: 'move', travel, whole })
  }

  /** Draws the tab at the driver's place. */
  async draw(moving: boolean): Promise<void> {
    if (this.builder.on && this.stage.classList.contains('stale')) return this.unsolved()
    // Tools work on what is drawn: not on a text that is no longer there.
    if (!this.opened || (this.builder.on && this.read !== this.editor.text)) return
    const { generation, tab } = this
    const travel = moving || this.travel !== 0 ? this.travel : null
    try {
      if (this.tab === 'steps') {
        await this.drawSteps()
        const { answers } = await this.frame([], null, true)
        if (answers && generation === this.generation) this.answer({ figures: [], missing: [], answers, verdict: this.opened.verdict })
        return
      }
      if (tab in TOLD) return await this.report(tab)
      const what = tab === 'live' ? LIVE : [tab]
      const frame = await this.frame(what, travel, true)
      if (generation !== this.generation || tab !== this.tab) return
      this.answer(frame)
      if (this.builder.on && this.tab === 'live') return await this.builder.show(frame)
      const pages = frame.figures
      if (!pages.length) this.hint(this.say_missing(frame.missing))
      this.show(pages, travel === null && this.hold)
      if (moving) this.hint('')
    } catch (fault) {
      if (fault instanceof Refused) this.hint(fault.diagnostics[0]?.message[this.lang] ?? fault.message)
      else if (!(fault instanceof Ended)) throw fault
    }
  }

  private async report(tab: string): Promise<void> {
    const { generation } = this
    this.moving = false
    const { pages, control, below } = await this.told.drawn(tab)
    if (generation !== this.generation || this.tab !== tab) return
    const held = this.stage.querySelector('label.report :focus') !== null
    this.show(pages, false)
    this.stage.append(below)
    if (control) this.stage.prepend(control)
    if (held) control?.querySelector<HTMLElement>('input, select')?.focus()
  }

  private say_missing(missing: Diagnostic[]): string {
    return missing[0]?.message[this.lang] ?? word('none', this.lang)
  }

  private show(pages: Page[], hold: boolean): void {
    const names = pages.map((p) => `${p.figure ?? ''}/${p.name}`)
    this.stage.querySelectorAll('.report').forEach((one) => one.remove())
    for (const [name, pane] of this.panes) {
      if (names.includes(name)) continue
      pane.root.remove()
      this.panes.delete(name)
    }
    pages.forEach((page, k) => {
      let pane = this.panes.get(names[k]!)
      if (!pane) {
        pane = new Pane(page.figure ?? '')
        this.panes.set(names[k]!, pane)
      }
      if (pane.root.parentElement !== this.stage || this.stage.children[k] !== pane.root) this.stage.insertBefore(pane.root, this.stage.children[k] ?? null)
      pane.show(page, hold)
    })
    this.stage.dataset.tab = this.tab
    this.stage.dataset.count = String(pages.length)
    this.arrange()
  }

  /** The panes that move together have one scale; a single figure has the width of the stage. */
  private arrange(): void {
    if (!this.panes.size) return this.stage.classList.remove('beside')
    const alone = this.tab !== 'live' && this.tab !== 'steps'
    const narrow = alone || matchMedia('(max-width: 820px)').matches
    const large = document.body.classList.contains('classroom') ? 4 : undefined
    arrange(this.stage, [...this.panes.values()], narrow, alone ? Infinity : innerHeight / 2, large)
  }

  private async drawSteps(): Promise<void> {
    const generation = this.generation
    if (!this.steps) {
      const message: Record<string, unknown> = { do: 'steps', handle: this.opened!.handle, lang: this.lang }
      if (this.dark) message.style = 'dark'
      const { figures } = await this.engine.ask<{ figures: Page[] }>(message)
      if (generation !== this.generation) return
      this.steps = figures
    }
    this.showStep()
  }

  private showStep(): void {
    const steps = this.steps ?? []
    this.stepAt = Math.min(Math.max(this.stepAt, 0), steps.length - 1)
    const page = steps[this.stepAt]
    if (page) this.show([{ ...page, name: 'step', figure: 'step' }], true)
    this.dressTransport()
  }

  // --- The driver ---

  /** Moves the driver; the newest place wins. */
  go(travel: number): void {
    if (!this.course) return
    this.travel = this.course.within(travel)
    this.readPlace()
    this.wanted = true
    if (this.drawing) return
    this.drawing = true
    const loop = async () => {
      while (this.wanted) {
        this.wanted = false
        await this.draw(true)
      }
      this.drawing = false
    }
    void loop()
  }

  /** Puts the driver's place into the text. */
  async settle(): Promise<void> {
    if (!this.opened || this.travel === 0) return
    const generation = this.generation
    type Placed = { edit?: { from: number; to: number; insert: string } }
    const placed = await this.engine.ask<Placed>({ do: 'place', handle: this.opened.handle, travel: this.travel }).catch(() => ({}) as Placed)
    if (generation !== this.generation) return
    if (placed.edit) this.editor.change(placed.edit)
  }

  private play(): void {
    if (!this.course?.can) return
    this.playing = true
    const { low, high, motion } = this.course
    const rate = ((high - low) / TURN) * (motion.back ? -1 : 1)
    let sense = 1
    let before = performance.now()
    const tick = (now: number) => {
      if (!this.playing || !this.course) return
      const by = rate * sense * Math.min((now - before) / 1000, 0.1)
      before = now
      const next = this.travel + by
      if (!motion.full && (next > high || next < low)) sense = -sense
      else this.go(next)
      requestAnimationFrame(tick)
    }
    requestAnimationFrame(tick)
    this.dressTransport()
  }

  pause(): void {
    if (!this.playing) return
    this.playing = false
    this.dressTransport()
  }

  private grab(event: PointerEvent): void {
    const svg = (event.target as Element).closest<HTMLElement>('.pane[data-figure="mechanism"]')?.querySelector('svg')
    const { course } = this
    if (!svg || !course?.can || event.button !== 0) return
    this.pause()
    const pane = this.panes.get('mechanism/mechanism')!
    const place = (e: PointerEvent): [number, number] => {
      const at = new DOMPoint(e.clientX, e.clientY).matrixTransform((pane.svg ?? svg).getScreenCTM()!.inverse())
      const [x, y] = pane.fixed
      return [at.x - x, y - at.y]
    }
    const first = place(event)
    const grip = course.grip(this.travel)
    if (!grip) return
    event.preventDefault()
    this.stage.setPointerCapture(event.pointerId)
    const move = (e: PointerEvent) => {
      const now = place(e)
      this.go(course.nearest([grip[0] + now[0] - first[0], grip[1] + now[1] - first[1]], this.travel))
    }
    const end = () => {
      this.stage.removeEventListener('pointermove', move)
      this.stage.removeEventListener('pointerup', end)
      this.stage.removeEventListener('pointercancel', end)
      void this.settle()
    }
    this.stage.addEventListener('pointermove', move)
    this.stage.addEventListener('pointerup', end)
    this.stage.addEventListener('pointercancel', end)
  }

  private key(event: KeyboardEvent): void {
    const inside = (event.target as Element).closest('.cm-editor, input, dialog')
    if (inside || event.ctrlKey || event.metaKey || event.altKey) return
    if (event.key === ' ' && !(event.target as Element).closest('button, select')) {
      event.preventDefault()
      if (this.playing) this.stop()
      else this.play()
    } else if (event.key === 'ArrowRight' || event.key === 'ArrowLeft') {
      const by = event.key === 'ArrowRight' ? 1 : -1
      if (this.tab === 'steps') {
        this.stepAt += by
        this.showStep()
      } else if (this.course) this.go(this.travel + (by * (this.course.high - this.course.low)) / 360)
    } else if (event.key === 'Escape') this.classroom(false)
  }

  private stop(): void {
    this.pause()
    void this.settle()
  }

  // --- What is around the drawings ---

  answer(frame: Frame): void {
    this.answers.show(frame, this.lang)
  }

  /** Shows diagnostics in the text and below the answers. */
  private tell(list: Diagnostic[], stale = false): void {
    this.editor.mark(list, this.lang)
    const items = list.slice(0, 20).map((d) => {
      const go = () => d.place && this.editor.show(d.place)
      const help = d.help && element('span', { class: 'help' }, d.help[this.lang])
      return element('li', { class: d.severity }, element('button', { class: 'quiet', click: go }, d.message[this.lang]), help)
    })
    this.faults.replaceChildren(...items)
    this.hint(stale ? word('stale', this.lang) : '')
  }

  hint(text: string): void {
    this.note.textContent = text
  }

  private say(key: Word): void {
    this.hint(word(key, this.lang))
  }

  private dress(): void {
    document.documentElement.lang = this.lang === 'zh' ? 'zh-CN' : 'en'
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light'
    this.bar.replaceChildren(...[
      element('h1', { title: this.filed.name ?? '' }, this.filed.name ?? 'hodograph'),
      this.filed.name !== null && this.button('store', () => void this.filed.save(), word('store', this.lang)),
      this.button('gallery', () => void this.gallery.open(this.lang), word('gallery', this.lang)),
      this.button('create', () => this.create(), word('create', this.lang)),
      this.button('build', () => this.build(!this.builder.on), word('build', this.lang)),
      this.title,
      this.button('cancel', () => this.cancel(), word('cancel', this.lang)),
      this.button('undo', () => this.editor.undo(), '↶'),
      this.button('redo', () => this.editor.redo(), '↷'),
      this.saves.menu(),
      // The address of a file is this machine's own.
      this.filed.name === null && this.button('share', () => void this.share(), word('share', this.lang)),
      this.button('classroom', () => this.classroom(true), word('classroom', this.lang)),
      this.button('leave', () => this.classroom(false), '✕'),
      this.button('text', () => document.body.classList.toggle('texted'), '{ }'),
      this.button('theme', () => this.setTheme(!this.dark), '◐'),
      this.button('other', () => this.setLang(this.lang === 'en' ? 'zh' : 'en'), word('other', this.lang)),
    ].filter((one) => one !== false))
    this.buttons()
    this.dressTabs()
    this.dressTransport()
    this.builder.dress()
  }

  private button(key: Word, click: () => void, shown: string): HTMLButtonElement {
    const title = word(key, this.lang)
    return element('button', { class: `b-${key}`, click, title, 'aria-label': title }, shown)
  }

  buttons(): void {
    const { undo, redo } = this.editor.can
    this.bar.querySelector('.b-build')?.setAttribute('aria-pressed', String(this.builder.on))
    this.bar.classList.toggle('changed', this.filed.changed)
    for (const [key, can] of [['undo', undo], ['redo', redo], ['store', this.filed.changed]] as const) {
      const button = this.bar.querySelector<HTMLButtonElement>(`.b-${key}`)
      if (button) button.disabled = !can
    }
  }

  private dressTabs(): void {
    document.body.dataset.tab = this.tab
    const scene = !['task', 'motion', 'equation'].includes(this.opened?.kind ?? '')
    const singles = SINGLE.filter((name) => this.pages.has(name) || name === 'sheet' || name === this.tab || (SLOW.includes(name) && this.course?.can))
    const single = this.course?.can && typeof this.opened?.swept === 'number'
    const reports = Object.entries(TOLD)
      .filter(([name, { moves, beside }]) => name === this.tab || ((!moves || single) && (!beside || this.pages.has(beside))))
      .map(([name]) => name)
    const names = scene ? ['live', 'steps', ...singles, ...reports] : ['sheet']
    const tab = (name: string) =>
      element(
        'button',
        { role: 'tab', 'aria-selected': String(name === this.tab), 'data-tab': name, click: () => void this.choose(name) },
        isWord(name) ? word(name, this.lang) : name,
      )
    const { scrollLeft } = this.tabs
    this.tabs.replaceChildren(...names.map(tab))
    this.tabs.scrollLeft = scrollLeft
  }

  async choose(name: string): Promise<void> {
    this.tab = name
    this.hint('')
    this.dressTabs()
    this.tabs.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: 'nearest', inline: 'nearest' })
    const known = this.travel === 0 ? this.pages.get(name) : undefined
    if (known) this.show(known, this.hold)
    else await this.draw(false)
    this.dressTransport()
  }

  private dressTransport(): void {
    const t = (key: Word) => word(key, this.lang)
    if (this.tab === 'steps') {
      const count = this.steps?.length ?? 0
      const go = (by: number) => () => {
        this.stepAt += by
        this.showStep()
      }
      this.transport.replaceChildren(
        element('button', { click: go(-1), 'aria-label': t('previous'), title: t('previous') }, '◀'),
        element('output', { class: 'reading' }, `${t('step')} ${count ? this.stepAt + 1 : 0} / ${count}`),
        element('button', { click: go(1), 'aria-label': t('next'), title: t('next') }, '▶'),
      )
      this.transport.hidden = !count
      return
    }
    this.transport.hidden = !this.course?.can
    if (!this.course) return
    const label = t(this.playing ? 'pause' : 'play')
    const play = element('button', { click: () => (this.playing ? this.stop() : this.play()), 'aria-label': label, title: label, class: 'play' }, this.playing ? '❚❚' : '▶')
    this.slider.min = String(this.course.low)
    this.slider.max = String(this.course.high)
    this.slider.setAttribute('aria-label', t('position'))
    this.transport.replaceChildren(play, this.slider, this.reading)
    this.readPlace()
  }

  private readPlace(): void {
    if (!this.course) return
    this.slider.value = String(this.travel)
    const driver = typeof this.opened?.swept === 'number' ? this.opened.drivers?.[this.opened.swept] : undefined
    this.reading.replaceChildren(...this.course.text(this.travel, driver?.turns ?? true, driver?.name ?? 'φ'))
  }

  // --- Acts ---

  cancel(): void {
    this.engine.cancel()
    this.pause()
  }

  /** The files of a form. */
  readonly files = (form: string, of?: string) => this.saves.files(form, of)

  /** Begins with an empty scene. */
  private create(): void {
    this.name = 'scene'
    history.replaceState(null, '', location.pathname + location.search)
    this.tab = 'live'
    this.builder.begin()
    this.dress()
  }

  /** Opens and closes the tools of building. */
  build(on: boolean): void {
    this.builder.open(on)
    this.buttons()
    void this.choose('live')
  }

  private async share(): Promise<void> {
    history.replaceState(null, '', await fragment(this.editor.text))
    try {
      await navigator.clipboard.writeText(location.href)
    } catch {
      // The address bar has it.
    }
    this.say('shared')
  }

  private classroom(on: boolean): void {
    document.body.classList.toggle('classroom', on)
    if (on) void document.documentElement.requestFullscreen?.().catch(() => {})
    else if (document.fullscreenElement) void document.exitFullscreen()
  }

  setLang(lang: Lang): void {
    this.lang = lang
    localStorage.setItem('lang', lang)
    this.dress()
    void this.open()
  }

  setTheme(dark: boolean): void {
    this.dark = dark
    localStorage.setItem('theme', dark ? 'dark' : 'light')
    this.dress()
    this.pages.clear()
    this.steps = null
    void this.draw(false)
  }

  private dropping(): void {
    window.addEventListener('dragover', (event) => event.preventDefault())
    window.addEventListener('drop', (event) => {
      const file = event.dataTransfer?.files[0]
      if (!file) return
      event.preventDefault()
      if (file.size > LARGEST) return this.say('rejected')
      void file.text().then((text) => {
        this.begin(text, file.name.replace(/\.json$/, ''))
      })
    })
  }
}

/** Lets pass that the engine was ended. */
function ended(fault: unknown): void {
  if (!(fault instanceof Ended)) throw fault
}
