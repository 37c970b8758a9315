// The engine alone, in Node: every message on every template, without a panic. HODOGRAPH_QUICK=1 takes a part of the templates.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { engine } from '../node-engine.js'

const at = (name) => new URL(`../public/${name}`, import.meta.url).pathname
const quick = process.env.HODOGRAPH_QUICK === '1'
const FIGURES = ['sheet', 'equations', 'results', 'centres', 'loops', 'composite', 'curvature', 'centrodes', 'forces', 'lever', 'gears', 'kutzbach', 'attempts', 'groups', 'cam', 'curves', 'cycle', 'cam-alpha']

test('every message is answered on every template', async () => {
  const fresh = () => engine(at('engine.wasm'), at('song.otf'))
  let ask = await fresh()
  const { templates } = ask({ do: 'templates' })
  const failed = []
  for (const { name, kind } of templates.filter((_, k) => !quick || k % 5 === 0)) {
    const { text } = ask({ do: 'template', name })
    const messages = [
      { do: 'motion' },
      { do: 'frame', what: ['mechanism', 'velocity', 'acceleration'], travel: 0.01, answers: true },
      { do: 'frame', what: kind === 'scene' ? FIGURES : ['sheet'], lang: 'zh', answers: true },
      ...(kind === 'scene' ? [{ do: 'place', travel: 0.1 }, { do: 'export', form: 'csv' }, { do: 'export', form: 'dxf' }] : []),
      ...['html', 'lesson', 'text', 'json'].map((form) => ({ do: 'export', form })),
    ]
    for (const message of messages) {
      try {
        const { handle } = ask({ do: 'open', text })
        const told = ask({ ...message, handle })
        if (!told.ok) failed.push(`${name} ${message.do} ${message.form ?? ''}: ${told.refused ?? told.diagnostics[0].message.en}`)
        ask({ do: 'close', handle })
      } catch (fault) {
        failed.push(`${name} ${message.do} ${message.form ?? ''}: ${ask.fault()}`)
        ask = await fresh()
      }
    }
  }
  assert.deepEqual(failed, [])
})
