// The engine as promises. It lives in a worker that is ended and started again on a trap or when a computation is cancelled.

import { asset } from './assets'
import EngineWorker from './worker?worker&inline'

export interface Both { en: string; zh: string }
export interface Place { from: number; to: number }
export interface Diagnostic {
  severity: 'note' | 'warning' | 'error'
  code: string
  message: Both
  help: Both | null
  place: Place | null
}
export interface Driver { name: string; turns: boolean; position: number | null; rate: number; led: boolean; kind: string }
export interface Names { points: string[]; links: string[]; parameters: string[] }
export interface Opened {
  handle: number
  kind: 'scene' | 'task' | 'motion' | 'equation'
  title: string | null
  language: 'en' | 'zh'
  drivers: Driver[] | null
  swept: number | 't' | null
  names: Names | null
  candidates: number | null
  diagnostics: Diagnostic[]
  verdict: Verdict
}
export type Verdict = 'answered' | 'disagree' | 'unanswered'
/** A page: its document, or while it moves the changes of its document. */
export interface Page {
  name: string
  figure?: string
  svg: string
  notes: Diagnostic[]
  delta?: Delta
  /** Transform of the mechanism: millimetres for a metre, and where (mm, y down) the origin of the plane is. */
  paper?: { scale: number; origin: [number, number] } | null
}
/** Changes of a document's elements, counted from 0 after the definitions: removed, then added, then changed and moved. */
export interface Delta {
  size: [number, number] | null
  desc: string | null
  letters: string | null
  removed: number[]
  added: [number, string][]
  changed: [number, string][]
  moved: [number, string][]
}
/** An answer; its symbol is MathML. */
export interface Answer { find: string; symbol: string; text: string; answered: boolean; difference: number | null }
export interface Frame { figures: Page[]; missing: Diagnostic[]; answers: Answer[] | null; verdict: Verdict; plane?: Plane | null }
/** The mechanism in its plane (m). */
export interface Plane {
  ground: string
  points: { name: string; at: [number, number] | null; links: string[] }[]
  links: { name: string; points: string[] }[]
  guides: { pin: string | null; slider: string | null; on: string; at: [number, number]; direction: [number, number] }[]
}
export interface Pose { travel: number; grip: [number, number] | null; places: ([number, number] | null)[] }
export interface Motion {
  poses: Pose[]
  /** The points whose places the poses give; none where nothing moves. */
  points?: string[]
  full: boolean
  period: number | null
  back: boolean
  start: number
  time: boolean
}

/** The engine refused a message: its diagnostics say why. */
export class Refused extends Error {
  constructor(readonly diagnostics: Diagnostic[], why?: string, readonly names: Names | null = null) {
    super(why ?? diagnostics[0]?.message.en ?? 'refused')
  }
}
/** The engine was ended, by a trap or by the user. */
export class Ended extends Error {
  constructor(readonly trap: string | null) {
    super(trap ?? 'cancelled')
  }
}

interface Waiting { resolve(answer: string): void; reject(fault: Error): void }

export class Engine {
  /** Called when the engine was ended: all handles are gone. */
  onEnd: (trap: string | null) => void = () => {}
  /** Called when the number of waiting messages becomes zero or leaves it. */
  onBusy: (busy: boolean) => void = () => {}
  private worker?: Worker
  private module?: Promise<WebAssembly.Module>
  private writer?: Promise<WebAssembly.Module>
  /** The Chinese font, once it is needed. */
  private font?: ArrayBuffer
  private last = 0
  private waiting = new Map<number, Waiting>()

  /** Sends a message; the answer has the fields of `T`. */
  async ask<T>(message: Record<string, unknown>): Promise<T> {
    if (message.lang === 'zh') await this.giveSong()
    const told = await this.told<T>(message)
    // A letter that no font here has: once with the Chinese font too.
    const pages = (told as { figures?: Page[] }).figures
    if (!this.font && pages?.some((p) => p.notes.some((n) => n.code === 'missing-glyph'))) {
      await this.giveSong()
      return this.told<T>(message)
    }
    return told
  }

  get busy(): boolean {
    return this.waiting.size > 0
  }

  /** Ends what the engine does; all that waits for it fails. */
  cancel(): void {
    this.end(null)
  }

  private async told<T>(message: Record<string, unknown>): Promise<T> {
    const answer = JSON.parse(await this.post({ message: JSON.stringify(message) }))
    if (!answer.ok) throw new Refused(answer.diagnostics, answer.refused, answer.names)
    return answer as T
  }

  /** Gives the engine the Chinese font. */
  async giveSong(): Promise<void> {
    if (this.font) return
    const font = await asset('song.otf')
    if (this.font) return
    this.font = font
    this.worker?.postMessage({ id: 0, font })
  }

  /** The PDF of pages as the engine tells them. Its writer is another module, which lives as long as it writes. */
  async pdf(pages: string): Promise<Uint8Array<ArrayBuffer>> {
    await this.giveSong()
    this.writer ??= asset('pdf.wasm').then((bytes) => WebAssembly.compile(bytes))
    const module = await this.writer
    const worker = new EngineWorker()
    try {
      const bytes = await new Promise<Uint8Array<ArrayBuffer>>((resolve, reject) => {
        worker.onmessage = ({ data }) => {
          if (data.trap !== undefined) reject(new Ended(data.trap))
          else if (data.bytes) resolve(data.bytes)
        }
        worker.postMessage({ id: 0, module, font: this.font, bytes: Uint8Array.from(atob(pages), (c) => c.charCodeAt(0)) })
      })
      if (bytes[0] === 0x25) return bytes
      throw new Refused([{ severity: 'error', code: 'pdf', message: JSON.parse(new TextDecoder().decode(bytes)), help: null, place: null }])
    } finally {
      worker.terminate()
    }
  }

  private async started(): Promise<Worker> {
    if (this.worker) return this.worker
    this.module ??= asset('engine.wasm').then((bytes) => WebAssembly.compile(bytes))
    const module = await this.module
    if (!this.worker) {
      this.worker = new EngineWorker()
      this.worker.onmessage = (event) => this.answered(event.data)
      this.worker.postMessage({ id: 0, module })
      if (this.font) this.worker.postMessage({ id: 0, font: this.font })
    }
    return this.worker
  }

  private async post(data: Record<string, unknown>): Promise<string> {
    const worker = await this.started()
    const id = ++this.last
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject })
      if (this.waiting.size === 1) this.onBusy(true)
      worker.postMessage({ id, ...data })
    })
  }

  private answered({ id, answer, trap }: { id: number; answer?: string; trap?: string }): void {
    const one = this.waiting.get(id)
    if (!one) return
    if (trap !== undefined) {
      this.end(trap)
      return
    }
    this.waiting.delete(id)
    if (this.waiting.size === 0) this.onBusy(false)
    one.resolve(answer!)
  }

  private end(trap: string | null): void {
    this.worker?.terminate()
    this.worker = undefined
    const all = [...this.waiting.values()]
    this.waiting.clear()
    this.onBusy(false)
    for (const one of all) one.reject(new Ended(trap))
    this.onEnd(trap)
  }
}
