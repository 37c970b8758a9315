// The gallery of templates: pictures by topic, searchable in both languages.

import { asset } from './assets'
import { element } from './dom'
import type { Both } from './engine'
import { word, type Lang } from './words'

interface Data {
  topics: { en: string; zh: string; names: string[] }[]
  templates: { name: string; kind: string; title: Both }[]
  pictures: Record<string, string>
}

export class Gallery {
  private dialog = element('dialog', { class: 'gallery' })
  private data?: Promise<Data>
  private urls = new Map<string, string>()

  constructor(private chosen: (name: string) => void) {
    document.body.append(this.dialog)
    this.dialog.addEventListener('click', (event) => {
      if (event.target === this.dialog) this.dialog.close()
    })
  }

  async open(lang: Lang): Promise<void> {
    this.data ??= asset('gallery.json').then((bytes) => JSON.parse(new TextDecoder().decode(bytes)))
    const data = await this.data
    const search = element('input', { type: 'search', placeholder: word('search', lang), 'aria-label': word('search', lang) })
    const list = element('div', { class: 'cards' })
    search.addEventListener('input', () => this.fill(list, data, search.value, lang))
    this.fill(list, data, '', lang)
    const close = element('button', { class: 'quiet', click: () => this.dialog.close(), 'aria-label': word('close', lang) }, '✕')
    this.dialog.replaceChildren(element('header', {}, element('h2', {}, word('gallery', lang)), search, close), list)
    this.dialog.setAttribute('aria-label', word('gallery', lang))
    this.dialog.showModal()
    search.focus()
  }

  private fill(list: HTMLElement, data: Data, sought: string, lang: Lang): void {
    const words = sought.toLowerCase().split(/\s+/).filter(Boolean)
    const sections = data.topics.flatMap((topic) => {
      const cards = topic.names.flatMap((name) => {
        const one = data.templates.find((t) => t.name === name)
        const all = `${name} ${one?.title.en} ${one?.title.zh} ${topic.en} ${topic.zh}`.toLowerCase()
        return one && words.every((w) => all.includes(w)) ? [this.card(one, data, lang)] : []
      })
      return cards.length ? [element('section', {}, element('h3', {}, topic[lang]), element('div', { class: 'grid' }, ...cards))] : []
    })
    list.replaceChildren(...(sections.length ? sections : [element('p', { class: 'none' }, word('nothing', lang))]))
  }

  private card(one: Data['templates'][number], data: Data, lang: Lang): HTMLElement {
    let url = this.urls.get(one.name)
    if (!url) {
      url = URL.createObjectURL(new Blob([data.pictures[one.name] ?? ''], { type: 'image/svg+xml' }))
      this.urls.set(one.name, url)
    }
    const open = () => {
      this.dialog.close()
      this.chosen(one.name)
    }
    const image = element('img', { src: url, alt: '', loading: 'lazy' })
    return element('button', { class: 'card', click: open, 'data-name': one.name }, image, element('span', {}, one.title[lang] || one.name))
  }
}
