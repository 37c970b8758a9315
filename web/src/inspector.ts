// The properties of a joint or link: its quantities to type, its name, and what is asked of it.

import type { JSONPath } from 'jsonc-parser'
import { element } from './dom'
import type { Outline } from './outline'
import { parameterOf, shown } from './quantities'
import { formula, word, type Lang, type Word } from './words'

export interface Selection { kind: 'point' | 'link'; name: string }

export interface InspectorInput {
  /** Writes a quantity that was typed; false if it is none. */
  type(path: JSONPath, text: string, usual: string): Promise<boolean>
  /** Sets a word that was chosen. */
  choose(path: JSONPath, value: string): void
  /** Gives the pin in a guide a block with a number. */
  block(guide: number): void
  /** Removes a part of the text. */
  drop(path: JSONPath): void
  rename(name: string): Promise<boolean>
  remove(): void
  drive(): void
  ask(find: string): void
}

const LAWS: Record<string, string> = {
  uniform: '等速', parabolic: '等加速等减速', harmonic: '简谐', cycloidal: '摆线', '3-4-5': '3-4-5', '4-5-6-7': '4-5-6-7',
  'modified-sine': '修正正弦', 'modified-trapezoidal': '修正梯形',
}

const links = (gear: any): string[] => (Array.isArray(gear.links) ? gear.links.filter((l: unknown) => typeof l === 'string') : [])

export class Inspector {
  readonly root = element('section', { class: 'inspector' })
  private outline!: Outline
  private lang: Lang = 'en'

  constructor(private input: InspectorInput) {}

  show(outline: Outline, selection: Selection | null, lang: Lang): void {
    // A field in which the user types is not taken away.
    const focused = this.root.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset.path : undefined
    this.outline = outline
    this.lang = lang
    this.root.setAttribute('aria-label', this.t('properties'))
    this.root.hidden = false
    if (!selection) {
      const drivers = outline.drivers().flatMap((_, k) => this.driver(k))
      this.root.hidden = !drivers.length
      this.root.replaceChildren(...drivers)
      return
    }
    this.root.replaceChildren(this.head(selection), ...(selection.kind === 'point' ? this.point(selection.name) : this.link(selection.name)))
    if (focused) this.root.querySelector<HTMLElement>(`[data-path='${focused}']`)?.focus()
  }

  /** Puts the cursor into the field of a quantity. */
  focus(ending: string): void {
    this.root.querySelector<HTMLInputElement>(`[data-path$='${ending}']`)?.select()
  }

  private t(key: Word): string {
    return word(key, this.lang)
  }

  private head({ kind, name }: Selection): HTMLElement {
    const field = element('input', { type: 'text', value: name, 'aria-label': this.t('name'), 'data-path': 'name', class: 'name', spellcheck: 'false' })
    field.addEventListener('change', () => void this.checked(field, field.value.trim() === name ? Promise.resolve(true) : this.input.rename(field.value.trim())))
    const what = kind === 'link' ? (name === this.outline.ground ? 'ground' : 'a_link') : this.outline.fixed(name) ? 'a_pivot' : 'a_joint'
    const remove = element('button', { class: 'quiet remove', title: this.t('delete'), 'aria-label': this.t('delete'), click: () => this.input.remove() }, '✕')
    return element('header', {}, element('span', {}, this.t(what)), field, remove)
  }

  private async checked(field: HTMLInputElement, done: Promise<boolean>): Promise<void> {
    field.setAttribute('aria-invalid', String(!(await done)))
  }

  /** A line with a quantity of the text. */
  private row(label: string | DocumentFragment, path: JSONPath, usual: string): HTMLElement {
    const value = path.reduce<any>((at, key) => at?.[key], this.outline.json)
    const parameter = parameterOf(this.outline, value)
    const id = path.join('-')
    const field = element('input', { type: 'text', value: shown(this.outline, value), 'data-path': path.join('.'), id, spellcheck: 'false', autocomplete: 'off' })
    field.addEventListener('change', () => void this.checked(field, this.input.type(path, field.value, usual)))
    field.addEventListener('keydown', (event) => event.key === 'Enter' && field.select())
    return element('label', { for: id }, element('span', {}, label), field, parameter === null ? null : element('small', {}, formula(parameter)))
  }

  private group(title: Word, ...rows: (HTMLElement | null)[]): HTMLElement[] {
    const all = rows.filter((r) => r !== null)
    return all.length ? [element('h2', {}, this.t(title)), ...all] : []
  }

  /** A group that is one entry of the text, with a button that removes it. */
  private entry(title: Word, path: JSONPath, ...rows: (HTMLElement | null)[]): HTMLElement[] {
    const label = `${this.t('delete')}: ${this.t(title)}`
    const remove = element('button', { class: 'quiet remove', title: label, 'aria-label': label, click: () => this.input.drop(path) }, '✕')
    const [head, ...rest] = this.group(title, ...rows)
    head?.append(remove)
    return head ? [head, ...rest] : [element('h2', {}, this.t(title), remove)]
  }

  private select(label: Word, chosen: string | undefined, options: [string, string][], choose: (value: string) => void): HTMLElement {
    const select = element('select', { 'aria-label': this.t(label) }, ...options.map(([value, text]) => element('option', { value, selected: value === chosen }, text)))
    select.addEventListener('change', () => choose(select.value))
    return element('label', {}, element('span', {}, this.t(label)), select)
  }

  private chips(finds: string[]): HTMLElement[] {
    const list: unknown[] = this.outline.list('find').length || Array.isArray(this.outline.json.find) ? this.outline.json.find : []
    const chip = (find: string) =>
      element('button', { class: 'chip', 'aria-pressed': String(list.includes(find)), 'data-find': find, click: () => this.input.ask(find) }, formula(find))
    return [element('h2', {}, this.t('ask')), element('div', { class: 'chips' }, ...finds.map(chip)), Array.isArray(this.outline.json.find) ? null : element('p', {}, this.t('all_asked'))].filter((e) => e !== null)
  }

  private point(name: string): HTMLElement[] {
    const { outline } = this
    const own = outline.json.points?.[name]
    const at = ['points', name]
    let coordinates: HTMLElement[] = []
    if (Array.isArray(own)) coordinates = this.group('coordinates', this.row(formula('x'), [...at, 0], 'mm'), this.row(formula('y'), [...at, 1], 'mm'))
    else if (own?.length !== undefined) coordinates = this.group('coordinates', this.row(this.t('length'), [...at, 'length'], 'mm'), this.row(this.t('angle'), [...at, 'angle'], 'deg'))
    else if (own) coordinates = this.group('coordinates', this.row(formula('x'), [...at, 'x'], 'mm'), this.row(formula('y'), [...at, 'y'], 'mm'))
    const lengths = outline.lengths().filter(({ ends }) => ends.includes(name)).map(({ key }) => this.row(key, ['lengths', key], 'mm'))
    const drivers = outline.drivers().flatMap((d, k) => (d.slide === name ? this.driver(k) : []))
    const guides = outline.guides.filter((g) => g.pin === name).flatMap((g) => this.guide(g.k))
    return [...coordinates, ...this.group('lengths', ...lengths), ...drivers, ...guides, ...(outline.fixed(name) ? [] : this.chips(['v', 'a', 'x', 'y'].map((q) => `${q}_${name}`)))]
  }

  private link(name: string): HTMLElement[] {
    const { outline } = this
    const points = outline.links.get(name) ?? []
    const lengths = outline.lengths().filter(({ ends }) => ends.every((p) => points.includes(p))).map(({ key }) => this.row(key, ['lengths', key], 'mm'))
    const drivers = outline.drivers().flatMap((d, k) => (d.link === name || (d.slide !== undefined && d.slide === name) ? this.driver(k) : []))
    const guides = outline.guides.filter((g) => g.slider === name || (g.on === name && name !== outline.ground)).flatMap((g) => this.guide(g.k))
    const gears = outline.list('gears').flatMap((gear, k) => (links(gear).includes(name) ? this.gear(gear, k) : []))
    const wheels = outline.list('rolling').flatMap((w, k) =>
      w.wheel === name ? this.entry('wheel', ['rolling', k], this.row(this.t('radius'), ['rolling', k, 'radius'], 'mm'), w.angle === undefined ? null : this.row(this.t('angle'), ['rolling', k, 'angle'], 'deg')) : [],
    )
    const cams = outline.list('cams').flatMap((cam, k) => (cam.cam === name || cam.follower === name ? this.cam(cam, k) : []))
    const moving = name !== outline.ground
    const drive = moving && !drivers.length ? element('button', { class: 'wide', click: () => this.input.drive() }, this.t('drive')) : null
    return [
      ...this.group('lengths', ...lengths), ...drivers, ...guides, ...gears, ...wheels, ...cams,
      ...(drive ? [drive] : []), ...(moving ? this.chips(['omega', 'alpha', 'phi'].map((q) => `${q}_${name}`)) : []),
    ]
  }

  private driver(k: number): HTMLElement[] {
    const { json } = this.outline
    const path: JSONPath = Array.isArray(json.driver) ? ['driver', k] : ['driver']
    const driver = this.outline.drivers()[k]
    const n = driver.link ?? driver.slide ?? ''
    if (driver.cylinder !== undefined) return this.entry('driver', path, this.row(this.t('length'), [...path, 'length'], 'mm'), this.row(this.t('rate'), [...path, 'rate'], 'm/s'))
    if (driver.slide !== undefined) {
      return this.entry('driver', path, this.row(formula(`s_${n}`), [...path, 'position'], 'mm'), this.row(formula(`v_${n}`), [...path, 'velocity'], 'm/s'), this.row(formula(`a_${n}`), [...path, 'acceleration'], 'm/s^2'))
    }
    return this.entry('driver', path, this.row(formula(`phi_${n}`), [...path, 'angle'], 'deg'), this.row(formula(`omega_${n}`), [...path, 'omega'], 'rad/s'), this.row(formula(`alpha_${n}`), [...path, 'alpha'], 'rad/s^2'))
  }

  private guide(k: number): HTMLElement[] {
    const guide = this.outline.list('guides')[k]
    const at: JSONPath = ['guides', k]
    const through = Array.isArray(guide.through) ? [this.row(formula('x'), [...at, 'through', 0], 'mm'), this.row(formula('y'), [...at, 'through', 1], 'mm')] : []
    // A block that is more than its pin remains.
    const own = guide.pin !== undefined && this.outline.json.links?.[guide.slider] === undefined
    const runs = own
      ? this.select('runs', guide.slider === undefined ? 'pin' : 'block', [['block', this.t('block')], ['pin', this.t('bare')]], (value) => (value === 'pin' ? this.input.drop([...at, 'slider']) : this.input.block(k)))
      : null
    return this.entry('guide', at, runs, this.row(this.t('angle'), [...at, 'angle'], 'deg'), ...through, this.row(this.t('offset'), [...at, 'offset'], 'mm'))
  }

  private gear(gear: any, k: number): HTMLElement[] {
    const sizes = (key: 'teeth' | 'radii', label: string, usual: string) =>
      (Array.isArray(gear[key]) ? gear[key] : []).map((_: unknown, n: number) => this.row(formula(`${label}_${links(gear)[n] ?? n + 1}`), ['gears', k, key, n], usual))
    const angle = gear.rack === undefined ? null : this.row(this.t('angle'), ['gears', k, 'angle'], 'deg')
    const phase = gear.phase === undefined ? null : this.row(this.t('phase'), ['gears', k, 'phase'], 'deg')
    const both = gear.rack === undefined && links(gear).length === 2 ? links(gear) : []
    const ring = both.length
      ? this.select('ring', gear.ring ?? '', [['', this.t('outside')], ...both.map((l): [string, string] => [l, `${this.t('ring_of')} ${l}`])], (value) =>
          value ? this.input.choose(['gears', k, 'ring'], value) : this.input.drop(['gears', k, 'ring']))
      : null
    return this.entry('gear', ['gears', k], ...sizes('teeth', 'z', ''), ...sizes('radii', 'r', 'mm'), ring, angle, phase)
  }

  private cam(cam: any, k: number): HTMLElement[] {
    const at: JSONPath = ['cams', k]
    const stages = (Array.isArray(cam.profile?.law) ? cam.profile.law : []).flatMap((stage: any, n: number) => {
      const path: JSONPath = [...at, 'profile', 'law', n]
      const kind = (['rise', 'return', 'dwell'] as const).find((key) => stage?.[key] !== undefined)
      if (!kind) return []
      if (kind === 'dwell') return [this.row(this.t('dwell'), [...path, 'dwell'], 'deg')]
      const laws = Object.entries(LAWS).map(([law, zh]): [string, string] => [law, this.lang === 'zh' ? zh : law])
      const law = this.select('law', stage.law, laws, (value) => this.input.choose([...path, 'law'], value))
      return [this.row(this.t(kind), [...path, kind], 'mm'), this.row(this.t('over'), [...path, 'over'], 'deg'), law]
    })
    const base = cam.profile?.base === undefined ? null : this.row(this.t('base'), [...at, 'profile', 'base'], 'mm')
    const roller = cam.roller?.radius === undefined ? null : this.row(this.t('roller'), [...at, 'roller', 'radius'], 'mm')
    return this.entry('cam', at, base, roller, ...stages)
  }
}
