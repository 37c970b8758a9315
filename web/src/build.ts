// Building with the mouse: each act makes an edit of the text, and what the engine says of the text is shown on the board.

import type { JSONPath } from 'jsonc-parser'
import { Act, EMPTY, type Target } from './acts'
import type { App } from './app'
import { Board, MILLIMETRE } from './board'
import { element, picture } from './dom'
import { Draft, difference } from './edits'
import { Ended, Refused, type Frame, type Opened, type Page, type Plane } from './engine'
import { Inspector, type Selection } from './inspector'
import { LIVE } from './motion'
import { distance, Outline, type XY } from './outline'
import { Grain, typed } from './quantities'
import { removed, renamed, taken } from './refer'
import { onScreen, sketch } from './sketch'
import { TOOLS, type Tool, type ToolName } from './tools'
import { word, type Word } from './words'

/** The part of the page that the builder sees. */
type Site = Pick<App, 'engine' | 'editor' | 'lang' | 'dark' | 'tab' | 'course' | 'travel' | 'go' | 'settle' | 'pause' | 'answer' | 'hint' | 'draw' | 'build'>

const NARROW = matchMedia('(max-width: 820px)')

export class Builder {
  on = false
  readonly root = element('div', { class: 'build', hidden: true })
  private board = new Board()
  private palette = element('div', { class: 'palette', role: 'toolbar' })
  private polygons = element('div', { class: 'polygons' })
  private inspector: Inspector
  private tool: Tool = TOOLS[0]!
  /** The tool that counts for the next click; those before are still to be done. */
  private wanted: ToolName = 'pointer'
  private steps: Target[] = []
  private armed: { name: string; points: string[] } | null = null
  private selected: Selection | null = null
  /** The places of points in the last drawing, for texts that do not have them. */
  private known = new Map<string, XY>()
  /** The text that is on the board, and those who wait for the next one. */
  private text: string | null = null
  private waiting: (() => void)[] = []
  private queue: Promise<void> = Promise.resolve()
  private fitted = false
  private timer = 0
  private page: Page | null = null
  /** The newest text of a drag, while it is drawn. */
  private candidate: string | null = null
  private trying = false

  constructor(private site: Site) {
    this.inspector = new Inspector({
      type: async (path, text, usual) => (await this.then(() => this.type(path, text, usual))) ?? false,
      choose: (path, value) => void this.then(() => this.edit((draft) => draft.put(path, value))),
      block: (k) => void this.then(() => this.act((act) => act.draft.put(['guides', k, 'slider'], act.number()))),
      drop: (path) => void this.then(() => this.edit((draft) => draft.drop(path))),
      rename: async (name) => (await this.then(() => this.rename(name))) ?? false,
      remove: () => void this.then(() => this.remove(this.selected)),
      drive: () => void this.then(() => this.selected && this.act((act) => void act.driver({ link: this.selected!.name, at: [0, 0] }))),
      ask: (find) => void this.then(() => this.act((act) => act.ask(find))),
    })
    this.root.append(this.palette, this.board.root, element('div', { class: 'beside' }, this.inspector.root, this.polygons))
    const { root } = this.board
    root.addEventListener('pointerdown', (event) => this.down(event))
    root.addEventListener('pointermove', (event) => this.hover(this.board.pixel(event), event.ctrlKey || event.metaKey))
    root.addEventListener('pointerleave', () => this.hover(null))
    root.addEventListener('wheel', (event) => {
      event.preventDefault()
      this.board.zoom(Math.exp(-event.deltaY / 500), this.board.pixel(event))
      this.redraw()
      this.again()
    }, { passive: false })
    document.addEventListener('keydown', (event) => this.key(event), { capture: true })
    // On a narrow screen there are no tools: what can be solved is seen as without them.
    NARROW.addEventListener('change', () => NARROW.matches && this.on && this.page && site.build(false))
    new ResizeObserver(() => {
      if (!this.fitted) this.fit()
      this.board.refresh()
    }).observe(root)
    this.dress()
  }

  /** Writes the words and signs of the tools. */
  dress(): void {
    const { lang } = this.site
    const button = (tool: Tool) => {
      const name = word(`tool_${tool.name}`, lang)
      const made = element('button', {
        class: `tool t-${tool.name}`, title: `${name} (${tool.letter})`, 'aria-label': name, 'aria-keyshortcuts': tool.letter,
        'aria-pressed': String(tool.name === this.wanted), click: () => this.take(tool.name),
      })
      made.append(picture(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">${tool.sign}</svg>`))
      return made
    }
    const fit = element('button', { class: 'tool', title: word('fit', lang), 'aria-label': word('fit', lang), click: () => this.fit(true) }, '⤢')
    this.palette.setAttribute('aria-label', word('build', lang))
    this.palette.replaceChildren(...TOOLS.map(button), fit)
    this.board.root.setAttribute('role', 'application')
    this.board.root.setAttribute('aria-label', `${word('board', lang)}`)
    this.properties()
    this.guide()
  }

  /** Opens and closes the tools. */
  open(on: boolean): void {
    this.on = on
    this.text = null
    this.fitted = false
    this.selected = null
    document.body.classList.toggle('building', on)
    this.root.hidden = !on
    this.take('pointer')
  }

  /** Begins with an empty scene. */
  begin(): void {
    this.known.clear()
    this.page = null
    this.open(true)
    this.site.editor.begin(EMPTY)
    this.take('pivot')
  }

  // --- What is on the board ---

  /** Shows the engine's drawing of the text. */
  async show(frame: Frame): Promise<void> {
    const { text } = this.site.editor
    const page = frame.figures.find((f) => f.figure === 'mechanism')
    if (!page || !frame.plane) return this.refused()
    this.page = page
    await this.read(text, frame.plane)
    this.polygon(frame.figures.filter((f) => f !== page))
    this.arrived(text)
  }

  /** Shows the sketch of a text that the engine refuses. */
  async refused(): Promise<void> {
    const { text } = this.site.editor
    this.page = null
    await this.read(text, null)
    this.polygon([])
    this.arrived(text)
  }

  private async read(text: string, plane: Plane | null): Promise<void> {
    const { board } = this
    const same = plane !== null && board.outline?.text === text && board.outline.solved
    board.trial = null
    const outline = same ? board.outline!.moved(plane) : await Outline.read(text, this.site.engine, this.known, plane)
    board.outline = outline
    for (const [name, at] of outline.places) this.known.set(name, at)
    const desc = plane && this.page ? /<desc>(.*?)<\/desc>/s.exec(this.page.svg)?.[1] : undefined
    board.root.setAttribute('aria-description', desc ?? '')
  }

  /** The text is on the board. */
  private arrived(text: string): void {
    this.text = text
    const { outline } = this.board
    const { steps, armed } = this
    if (steps.some((s) => s.point !== undefined && !outline!.points.includes(s.point)) || (armed && !outline!.links.has(armed.name))) this.drop()
    if (this.selected && !(this.selected.kind === 'point' ? outline!.places.has(this.selected.name) : outline!.links.has(this.selected.name))) this.selected = null
    if (!this.fitted) this.fit()
    this.redraw()
    this.properties()
    this.guide()
    this.waiting.splice(0).forEach((done) => done())
  }

  private polygon(pages: Page[]): void {
    this.polygons.replaceChildren(...pages.map((page) => element('figure', { 'data-figure': page.figure ?? '' }, picture(page.svg))))
  }

  private redraw(): void {
    const { board, page } = this
    const { outline, view } = board
    if (!outline) return
    board.grain = Grain.of(outline.text, view.scale)
    if (page?.paper) {
      const svg = picture(page.svg)
      // The grid is seen through the paper.
      svg.querySelector(':scope > rect.paper')?.remove()
      const [, , width, height] = svg.getAttribute('viewBox')!.split(' ').map(Number) as [number, number, number, number]
      const mm = view.scale / page.paper.scale
      const [x, y] = onScreen(view, [0, 0])
      const place = { x: x - page.paper.origin[0] * mm, y: y - page.paper.origin[1] * mm, width: width * mm, height: height * mm }
      for (const [name, value] of Object.entries(place)) svg.setAttribute(name, String(value))
      board.show(svg)
    } else board.show(sketch(outline, view, MILLIMETRE))
  }

  private fit(again = false): void {
    const { board } = this
    if (!this.on || !board.outline || !board.size[0]) return
    board.fit()
    this.fitted = true
    if (again) this.redraw()
    this.again()
  }

  /** The scale (m per mm) in which signs and letters have their size on the board. */
  get mu(): number | undefined {
    return this.on ? MILLIMETRE / this.board.view.scale : undefined
  }

  /** Asks for the drawing in a scale that was changed. */
  private again(): void {
    clearTimeout(this.timer)
    this.timer = window.setTimeout(() => this.page && void this.site.draw(this.site.travel !== 0), 150)
  }

  // --- Tools ---

  /** Takes a tool, after the clicks that were made before. */
  take(name: ToolName): void {
    for (const button of this.palette.querySelectorAll('.tool')) button.setAttribute('aria-pressed', String(button.classList.contains(`t-${name}`)))
    this.wanted = name
    this.board.root.dataset.tool = name
    this.queue = this.queue.then(() => {
      this.tool = TOOLS.find((t) => t.name === name)!
      this.drop()
    })
  }

  /** Forgets the steps of an act. */
  private drop(): void {
    this.steps = []
    this.armed = null
    this.marks()
    this.guide()
  }

  /** Says what the next click does. */
  private guide(): void {
    if (!this.on || NARROW.matches) return
    const key: Word = this.armed ? 'step_more' : (this.tool.steps[this.steps.length] ?? this.tool.steps[0]!)
    this.site.hint(`${word(`tool_${this.tool.name}`, this.site.lang)}: ${word(key, this.site.lang)}`)
  }

  private marks(): void {
    const { board, steps, armed, tool } = this
    board.marks = { selected: this.selected, pending: steps.map((s) => s.at), armed: armed?.name ?? null, band: steps.length > 0, tool: tool.name !== 'pointer' }
    board.refresh()
  }

  private hover(pixel: XY | null, fine = false): void {
    this.board.pointer = pixel && this.board.target(pixel, fine)
    this.marks()
  }

  /** One thing after the other, each on the newest drawing. */
  private then<T>(what: () => T | Promise<T>): Promise<T | undefined> {
    const done = this.queue.then(async () => {
      while (this.on && this.text !== this.site.editor.text) {
        await new Promise<void>((done) => {
          this.waiting.push(done)
          setTimeout(done, 15_000)
        })
      }
      return what()
    }).catch((fault) => {
      if (!(fault instanceof Ended)) reportError(fault)
      return undefined
    })
    this.queue = done.then(() => {})
    return done
  }

  private down(event: PointerEvent): void {
    this.board.root.focus({ preventScroll: true })
    // The drawing is not in the pose of the text: that comes first.
    if (this.site.travel !== 0) {
      this.site.pause()
      void this.site.settle()
      return
    }
    const pixel = this.board.pixel(event)
    const fine = event.ctrlKey || event.metaKey
    if (event.button === 1 || (event.button === 0 && this.wanted === 'pointer')) this.hold(event, pixel)
    else if (event.button === 0) {
      event.preventDefault()
      void this.then(() => this.click(pixel, fine))
    }
  }

  /** A click of a tool. */
  private click(pixel: XY, fine: boolean): void {
    const { steps, tool } = this
    const target = this.board.target(pixel, fine)
    const next = () => {
      steps.push(target)
      this.marks()
      this.guide()
    }
    const [from] = steps
    switch (tool.name) {
      case 'pivot': return this.act((act) => this.select('point', act.pivot(target)))
      case 'node':
        if (target.link === undefined) return this.say('no_link')
        return this.act((act) => this.select('point', act.onLink(target.link!, target.at)))
      case 'driver': return this.act((act) => {
        this.selected = act.driver(target) ?? this.selected
      }, () => this.take('pointer'))
      case 'delete': return target.point !== undefined ? this.remove({ kind: 'point', name: target.point }) : target.link !== undefined ? this.remove({ kind: 'link', name: target.link }) : undefined
      case 'link': return this.link(target, next)
      case 'slot':
      case 'gear':
      case 'rack':
        if (!from && target.point === undefined && target.link === undefined) return this.say('no_link')
    }
    if (!from) return next()
    const acts: Partial<Record<ToolName, (act: Act) => string | null>> = {
      slider: (act) => act.groundSlider(from, target.at),
      slot: (act) => act.linkSlider(from, target),
      wheel: (act) => act.wheel(from, target),
      gear: (act) => act.gears(from, target),
      rack: (act) => act.rack(from, target),
      cam: (act) => act.cam(from, target.at),
    }
    this.act((act) => {
      const made = acts[tool.name]?.(act)
      if (made) this.select('link', made)
    })
    this.drop()
  }

  private link(target: Target, next: () => void): void {
    const { armed, steps } = this
    const [from] = steps
    if (armed) {
      this.armed = null
      if (target.point !== undefined && armed.points.includes(target.point)) return next()
      this.act((act) => act.extend(armed.name, target))
      return this.guide()
    }
    if (!from) return next()
    this.act((act) => {
      this.armed = act.link(from, target)
      if (this.armed) this.select('link', this.armed.name)
    })
    this.steps = []
    this.guide()
  }

  private select(kind: Selection['kind'], name: string): void {
    this.selected = { kind, name }
  }

  // --- Acts ---

  /** Makes an act and puts its text into the editor: one step of the history. */
  private act(what: (act: Act) => void, then?: () => void): void {
    const { outline, grain } = this.board
    if (!outline || !grain) return
    const act = new Act(outline, grain)
    what(act)
    this.change(act.text)
    then?.()
  }

  private edit(what: (draft: Draft) => void): void {
    const draft = new Draft(this.site.editor.text)
    what(draft)
    this.change(draft.text)
  }

  private change(text: string): void {
    const edit = difference(this.site.editor.text, text)
    if (edit) this.site.editor.change(edit)
    else this.properties()
    this.marks()
  }

  private async type(path: JSONPath, text: string, usual: string): Promise<boolean> {
    const outline = this.board.outline!
    const draft = new Draft(this.site.editor.text)
    if (text.trim() === '') {
      draft.drop(path)
      this.change(draft.text)
      return true
    }
    typed(outline, draft, path, text, usual)
    const { values } = await this.site.engine.ask<{ values: (number | null)[] }>({ do: 'values', text: draft.text, of: [draft.at(path)] })
    if (values[0] === null) {
      this.say('no_quantity')
      return false
    }
    this.change(draft.text)
    return true
  }

  private async rename(name: string): Promise<boolean> {
    const { selected } = this
    const outline = this.board.outline!
    if (!selected || !/^[\p{L}\p{N}]+$/u.test(name) || taken(outline, name)) {
      this.say('taken')
      return false
    }
    const text = renamed(outline, selected.name, name)
    const faults = await Promise.all([outline.text, text].map((t) => this.faults(t)))
    if (faults[0] !== faults[1]) {
      this.say('unrenamed')
      return false
    }
    this.known.set(name, this.known.get(selected.name) ?? [0, 0])
    this.selected = { ...selected, name }
    this.change(text)
    return true
  }

  /** The codes of the faults of a text; none if it can be solved. */
  private async faults(text: string): Promise<string> {
    try {
      const { handle } = await this.site.engine.ask<Opened>({ do: 'open', text })
      void this.site.engine.ask({ do: 'close', handle }).catch(() => {})
      return ''
    } catch (fault) {
      if (fault instanceof Refused) return fault.diagnostics.map((d) => d.code).sort().join()
      throw fault
    }
  }

  private remove(what: Selection | null): void {
    const { outline, grain } = this.board
    if (!what || !outline || !grain) return
    if (what.name === outline.ground) return this.say('ground_remains')
    const told = removed(outline, what.name, what.kind, grain)
    if ('kept' in told) return this.site.hint(`${word('still', this.site.lang)} ${told.kept.join(', ')}`)
    this.selected = null
    this.change(told.text)
    this.properties()
  }

  private properties(): void {
    const { outline } = this.board
    if (this.on && outline) this.inspector.show(outline, this.selected, this.site.lang)
    this.marks()
  }

  private say(key: Word): void {
    this.site.hint(word(key, this.site.lang))
  }

  // --- The pointer: choosing, dragging, moving ---

  private hold(event: PointerEvent, first: XY): void {
    const { board, site } = this
    event.preventDefault()
    if (document.activeElement instanceof HTMLInputElement) document.activeElement.blur()
    board.root.setPointerCapture(event.pointerId)
    const label = event.button === 0 ? /mechanism-label-(angle|rotation|number)-(.+)$/.exec((event.target as Element).closest('[id]')?.id ?? '') : null
    if (label && board.outline?.links.has(label[2]!)) {
      this.select('link', label[2]!)
      this.properties()
      this.inspector.focus(label[1] === 'angle' ? 'angle' : label[1] === 'rotation' ? 'omega' : 'name')
      return
    }
    const target: Target = event.button === 0 && !NARROW.matches ? board.target(first, true) : { at: [0, 0] }
    const point = target.point
    const along = event.altKey && site.course?.can
    let last = first
    let moved = false
    let drag: { text: string; to: XY } | null = null
    if (point !== undefined) this.select('point', point)
    else if (target.link !== undefined) this.select('link', target.link)
    else if (event.button === 0 && board.onGround(first) && board.outline?.ground) this.select('link', board.outline.ground)
    else if (event.button === 0) this.selected = null
    if (along) site.pause()
    this.properties()
    const move = (e: PointerEvent) => {
      const pixel = board.pixel(e)
      if (!moved && distance(pixel, first) < 4) return
      moved = true
      if (point !== undefined && along) {
        const near = site.course!.nearestOf(point, board.target(pixel, true).at, site.travel)
        if (near !== null) site.go(near)
      } else if (point !== undefined) drag = this.dragged(point, pixel, e.ctrlKey || e.metaKey) ?? drag
      else if (target.link === undefined) {
        board.pan([pixel[0] - last[0], pixel[1] - last[1]])
        this.redraw()
      }
      last = pixel
    }
    const end = () => {
      for (const [name, does] of all) board.root.removeEventListener(name, does)
      this.candidate = null
      if (point !== undefined && along) void site.settle()
      else if (drag !== null) void this.then(() => this.land(point!, drag!))
    }
    const all = [['pointermove', move], ['pointerup', end], ['pointercancel', end]] as const
    for (const [name, does] of all) board.root.addEventListener(name, does)
  }

  /** The text with a joint at the pointer, which is drawn meanwhile. */
  private dragged(point: string, pixel: XY, fine: boolean): { text: string; to: XY } | null {
    const { board } = this
    const outline = this.board.outline!
    // From the text and its own pose, not from where the drag has come.
    if (this.text === null || outline.text !== this.site.editor.text) return null
    const place = board.grain!.snap(board.target([pixel[0], pixel[1]], true).at, fine)
    const act = new Act(outline, board.grain!)
    const at = act.move(point, place)
    if (!at) {
      this.say('unmovable')
      return null
    }
    this.candidate = act.text
    void this.attempt()
    return { text: act.text, to: place }
  }

  /**
   * Writes the text of a drag. Where a place is stated twice (a joint of a chain with a redundant link, a point on the edge of a cam), one of
   * the statements alone makes a text that the engine refuses: then the nearest place counts that it accepts, in the direction of the drag, of
   * the axes, or no other.
   */
  private async land(point: string, { text, to }: { text: string; to: XY }): Promise<void> {
    const { board, site } = this
    const outline = board.outline!
    const from = outline.places.get(point)
    if (!outline.solved || !from || (await this.faults(text)) === '') return this.change(text)
    const parts: XY[] = [[1, 0], [0, 1], [0.5, 0.5], [0.5, 0], [0, 0.5], [0.25, 0.25], [0.125, 0.125]]
    const places = parts.map(([x, y]): XY => board.grain!.snap([from[0] + x * (to[0] - from[0]), from[1] + y * (to[1] - from[1])], true))
    for (const place of places.sort((a, b) => distance(a, to) - distance(b, to))) {
      const act = new Act(outline, board.grain!)
      if (act.move(point, place) && act.text !== outline.text && (await this.faults(act.text)) === '') return this.change(act.text)
    }
    await site.draw(false)
    this.say('unmovable')
  }

  /** The engine's drawing of a text that is not yet in the editor. */
  private drawn(text: string): Promise<Frame> {
    const { engine, lang, dark } = this.site
    const style = dark ? { style: 'dark' } : {}
    return engine.ask<Frame>({ do: 'trial', text, what: LIVE, lang, answers: true, prefix: true, plane: true, mu: this.mu, ...style })
  }

  /** Draws the newest candidate of a drag. */
  private async attempt(): Promise<void> {
    if (this.trying) return
    this.trying = true
    while (this.candidate !== null) {
      const text = this.candidate
      this.candidate = null
      const frame = await this.drawn(text).catch((fault) => {
        if (fault instanceof Refused || fault instanceof Ended) return null
        throw fault
      })
      if (this.text !== this.site.editor.text) break
      const page = frame?.figures.find((f) => f.figure === 'mechanism')
      const trial = await Outline.read(text, this.site.engine, this.known, frame?.plane)
      if (this.text !== this.site.editor.text) break
      this.board.trial = trial
      if (frame && page) {
        this.page = page
        this.polygon(frame.figures.filter((f) => f !== page))
        this.site.answer(frame)
        this.redraw()
      } else this.board.show(sketch(trial, this.board.view, MILLIMETRE))
      this.inspector.show(trial, this.selected, this.site.lang)
    }
    this.trying = false
  }

  // --- The keyboard ---

  private key(event: KeyboardEvent): void {
    const place = event.target as Element
    if (!this.on || this.site.tab !== 'live' || place.closest('.cm-editor, input, select, dialog') || event.altKey) return
    const { board } = this
    if ((event.ctrlKey || event.metaKey) && /^[zy]$/i.test(event.key)) {
      if (event.key.toLowerCase() === 'y' || event.shiftKey) this.site.editor.redo()
      else this.site.editor.undo()
    } else if (event.ctrlKey || event.metaKey) return
    else if (event.key === 'Escape') {
      if (this.steps.length || this.armed) this.take(this.wanted)
      else if (this.wanted !== 'pointer') this.take('pointer')
      else return
    } else if (event.key === 'Delete' || event.key === 'Backspace') void this.then(() => this.remove(this.selected))
    else if (board.root === place && /^Arrow/.test(event.key)) this.step(event)
    else if (board.root === place && (event.key === 'Enter' || event.key === ' ') && board.pointer) {
      const pixel = onScreen(board.view, board.pointer.at)
      this.hover(pixel)
      if (this.wanted !== 'pointer') void this.then(() => this.click(pixel, false))
      else if (board.pointer.point !== undefined) this.select('point', board.pointer.point)
      else if (board.pointer.link !== undefined) this.select('link', board.pointer.link)
      this.properties()
    } else {
      const tool = TOOLS.find((t) => t.letter === event.key.toUpperCase())
      if (!tool) return
      this.take(tool.name)
    }
    event.preventDefault()
    event.stopPropagation()
  }

  /** Moves the place of the pointer by one line of the grid. */
  private step(event: KeyboardEvent): void {
    const { board } = this
    const grid = board.grain!.grid * (event.shiftKey ? 5 : 1)
    const [width, height] = board.size
    const at = board.pointer?.at ?? board.target([width / 2, height / 2], false).at
    const by = { ArrowLeft: [-grid, 0], ArrowRight: [grid, 0], ArrowUp: [0, grid], ArrowDown: [0, -grid] }[event.key] ?? [0, 0]
    this.hover(onScreen(board.view, [at[0] + by[0]!, at[1] + by[1]!]))
  }
}
