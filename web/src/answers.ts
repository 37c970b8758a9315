// The answers: symbols, values, and whether drawing and loop equations agree. While they are to be predicted, each is shown on a click.

import { element, markup } from './dom'
import type { Answer, Frame, Verdict } from './engine'
import { word, type Lang } from './words'

export class Answers {
  readonly root = element('div', { class: 'answers' })
  private predict = false
  /** The questions whose answers are shown while the others are to be predicted. */
  private revealed = new Set<string>()
  private last: [Answer[], Verdict] = [[], 'answered']

  /** Shows the answers of a frame. */
  show({ answers, verdict }: Pick<Frame, 'answers' | 'verdict'>, lang: Lang): void {
    if (!answers) return
    this.last = [answers, verdict]
    const toggle = element('button', { class: 'b-predict', 'aria-pressed': String(this.predict), click: () => this.turn(lang) }, word('predict', lang))
    const rows = answers.map((a) =>
      element('tr', { class: a.answered ? '' : 'none' }, element('th', { scope: 'row' }, markup(a.symbol), element('span', { class: 'unseen' }, a.find)), this.value(a, lang)),
    )
    const hides = this.predict && answers.some((a) => !this.revealed.has(a.find))
    this.root.replaceChildren(
      element('h2', {}, word('answers', lang), toggle),
      element('table', {}, element('tbody', {}, ...rows)),
      element('p', { class: `verdict ${verdict}` }, hides ? '' : summary(answers, verdict, lang)),
    )
    this.root.hidden = !rows.length
  }

  /** Hides the answers that were shown, for another mechanism. */
  forget(): void {
    this.revealed.clear()
  }

  private value(answer: Answer, lang: Lang): HTMLElement {
    if (!this.predict || this.revealed.has(answer.find)) return element('td', {}, answer.text)
    const reveal = () => {
      this.revealed.add(answer.find)
      this.show({ answers: this.last[0], verdict: this.last[1] }, lang)
    }
    return element('td', {}, element('button', { class: 'reveal', click: reveal, 'aria-label': `${word('reveal', lang)} ${answer.find}` }, word('reveal', lang)))
  }

  private turn(lang: Lang): void {
    this.predict = !this.predict
    this.revealed.clear()
    this.show({ answers: this.last[0], verdict: this.last[1] }, lang)
  }
}

/** The outcome in words. */
function summary(answers: Answer[], verdict: Verdict, lang: Lang): string {
  if (verdict === 'disagree' || verdict === 'unanswered') return word(verdict, lang)
  if (answers.every((a) => a.difference === null)) return ''
  return `${word('agree', lang)} ${bound(answers.reduce((most, a) => Math.max(most, a.difference ?? 0), 0))}`
}

/** A relative difference as a power of ten that it does not exceed. */
function bound(off: number): string {
  if (off === 0) return '0'
  const power = Math.ceil(Math.log10(off))
  return `10${[...String(power)].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)])).join('')}`
}
