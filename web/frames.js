// Times of the engine for each template: `npm run frames` after `npm run engine`. Milliseconds of the first moving picture, which reserves
// space for the whole motion, and of the pictures through it: median and 95th percentile, for mechanism, polygons and answers.
import { engine } from './node-engine.js'

const FRAMES = 60
const what = ['mechanism', 'velocity', 'acceleration']
const at = (name) => new URL(`public/${name}`, import.meta.url).pathname
const ask = await engine(at('engine.wasm'), at('song.otf'))

const timed = (message) => {
  const before = performance.now()
  const answer = ask(message)
  return [performance.now() - before, answer]
}

const rows = []
for (const { name } of ask({ do: 'templates' }).templates.filter((t) => t.kind === 'scene')) {
  const { handle } = ask({ do: 'open', text: ask({ do: 'template', name }).text })
  const { poses } = ask({ do: 'motion', handle })
  if (poses.length > 1) {
    const [first, begun] = timed({ do: 'move', handle, what, travel: 0, answers: true })
    if (begun.ok) {
      const [low, high] = [poses[0].travel, poses.at(-1).travel]
      const travels = Array.from({ length: FRAMES }, (_, k) => low + ((high - low) * (k + 0.5)) / FRAMES)
      const times = travels.map((travel) => timed({ do: 'move', handle, what, travel, answers: true })[0]).sort((a, b) => a - b)
      rows.push([name, first, times[FRAMES / 2], times[Math.floor(0.95 * FRAMES)]])
    }
  }
  ask({ do: 'close', handle })
}
rows.sort((a, b) => b[2] - a[2])
console.log(['template', 'first', 'median', '95 %'].join('\t'))
for (const [name, ...times] of rows) console.log([name, ...times.map((t) => t.toFixed(1))].join('\t'))
