// The text of the scene, which is the only state of the page: all changes go through its history.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete'
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory, redo, redoDepth, undo, undoDepth } from '@codemirror/commands'
import { json } from '@codemirror/lang-json'
import { bracketMatching, HighlightStyle, indentOnInput, syntaxHighlighting } from '@codemirror/language'
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic as Mark } from '@codemirror/lint'
import { Annotation, EditorState } from '@codemirror/state'
import { drawSelection, EditorView, highlightActiveLine, hoverTooltip, keymap, lineNumbers } from '@codemirror/view'
import { tags } from '@lezer/highlight'
import { complete, described, type Schema } from './complete'
import type { Diagnostic, Names, Place } from './engine'
import type { Lang } from './words'

/** Marks a change that does not come from the keyboard: it is drawn at once. */
const atOnce = Annotation.define<boolean>()

const colours = HighlightStyle.define([
  { tag: tags.propertyName, color: 'var(--key)' },
  { tag: tags.string, color: 'var(--string)' },
  { tag: [tags.number, tags.bool, tags.null], color: 'var(--number)' },
])

export interface EditorInput {
  parent: HTMLElement
  label: string
  schema(): Schema | null
  names(): Names | null
  changed(atOnce: boolean): void
}

export class Editor {
  private view: EditorView

  constructor(private input: EditorInput) {
    this.view = new EditorView({ parent: input.parent, state: this.fresh('') })
  }

  private fresh(doc: string): EditorState {
    const { schema, names, changed, label } = this.input
    return EditorState.create({
      doc,
      extensions: [
        lineNumbers(),
        history(),
        drawSelection(),
        indentOnInput(),
        bracketMatching(),
        closeBrackets(),
        highlightActiveLine(),
        json(),
        syntaxHighlighting(colours),
        lintGutter(),
        autocompletion({ override: [complete(schema, names)] }),
        hoverTooltip((view, pos) => {
          const told = described(view.state, pos, schema())
          if (!told) return null
          return { pos: told.from, end: told.to, create: () => ({ dom: Object.assign(document.createElement('div'), { className: 'hover', textContent: told.text }) }) }
        }),
        EditorView.contentAttributes.of({ 'aria-label': label, spellcheck: 'false', tabindex: '0' }),
        keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap, ...completionKeymap, ...lintKeymap, indentWithTab]),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged) return
          const quick = update.transactions.some((t) => t.annotation(atOnce) || t.isUserEvent('undo') || t.isUserEvent('redo'))
          changed(quick)
        }),
      ],
    })
  }

  get text(): string {
    return this.view.state.doc.toString()
  }

  get can(): { undo: boolean; redo: boolean } {
    return { undo: undoDepth(this.view.state) > 0, redo: redoDepth(this.view.state) > 0 }
  }

  undo(): void {
    undo(this.view)
  }

  redo(): void {
    redo(this.view)
  }

  /** Begins with a text: the history is empty. */
  begin(text: string): void {
    this.view.setState(this.fresh(text))
    this.input.changed(true)
  }

  /** Changes the text in one step of the history. */
  change(edit: Place & { insert: string }): void {
    this.view.dispatch({ changes: edit, annotations: [atOnce.of(true), isolateHistory.of('full')], userEvent: 'input.place' })
  }

  /** Shows diagnostics at their places; those without one are at the beginning. */
  mark(list: Diagnostic[], lang: Lang): void {
    const length = this.view.state.doc.length
    const marks: Mark[] = list.map((d) => {
      const from = Math.min(d.place?.from ?? 0, length)
      const to = Math.min(Math.max(d.place?.to ?? 0, from), length)
      const help = d.help ? `\n${d.help[lang]}` : ''
      return { from, to, severity: d.severity === 'note' ? 'info' : d.severity, message: d.message[lang] + help, source: d.code }
    })
    this.view.dispatch(setDiagnostics(this.view.state, marks))
  }

  /** Moves the cursor to a place. */
  show(place: Place): void {
    const anchor = Math.min(place.from, this.view.state.doc.length)
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: 'center' }) })
    this.view.focus()
  }
}
