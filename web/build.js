// Builds the page: dist/ is a folder for any static server, dist/hodograph.html the same in one file.
import { build } from 'vite'
import { createHash } from 'node:crypto'
import { readFile, readdir, rm, writeFile } from 'node:fs/promises'
import { deflateRawSync } from 'node:zlib'
import { engine } from './node-engine.js'
import { TOPICS } from './topics.js'

const at = (name) => new URL(name, import.meta.url)
const policy = (script, worker, connect) =>
  `default-src 'none'; script-src ${script} 'wasm-unsafe-eval'; worker-src ${worker}; connect-src ${connect}; style-src 'self' 'unsafe-inline'; ` +
  `img-src 'self' data: blob:; font-src 'self' data:; manifest-src 'self'; base-uri 'none'; form-action 'none'`

/** The pictures of the gallery, drawn by the engine, with titles and topics. */
async function gallery() {
  const ask = await engine(at('public/engine.wasm').pathname, at('public/song.otf').pathname)
  const { templates } = ask({ do: 'templates' })
  const pictures = {}
  for (const { name, kind } of templates) {
    const { text } = ask({ do: 'template', name })
    const file = ask({ do: 'open', text, lang: 'en' })
    const what = [kind === 'scene' ? 'mechanism' : 'sheet']
    const { figures } = ask({ do: 'frame', handle: file.handle, what, lang: 'en' })
    ask({ do: 'close', handle: file.handle })
    pictures[name] = bare(figures[0].svg)
  }
  const known = new Set(TOPICS.flatMap((t) => t.names))
  const others = templates.map((t) => t.name).filter((name) => !known.has(name))
  const topics = others.length ? [...TOPICS, { en: 'Others', zh: '其他', names: others }] : TOPICS
  await writeFile(at('public/gallery.json'), JSON.stringify({ topics, templates, pictures }))
}

/** A picture without what only programs read. */
function bare(svg) {
  // Without caption and scale below the drawing.
  const below = /<g[^>]*id="caption-[^"]*"[^>]*translate\([\d.]+ ([\d.]+)\)/.exec(svg)
  const cut = below ? svg.replace(/viewBox="0 0 ([\d.]+) [\d.]+"/, `viewBox="0 0 $1 ${below[1] - 4}"`).replace(/ (width|height)="[\d.]+mm"/g, '') : svg
  const kept = cut
    .replace(/<title>.*?<\/title>|<desc>.*?<\/desc>/gs, '')
    .replace(/ (data-[a-z]+|aria-label|class|role|lang)="[^"]*"/g, '')
    .replace(/ id="(?!g)[^"]*"/g, '')
  return kept.replace(/\n/g, '')
}

await gallery()
const outDir = at('dist').pathname
await rm(outDir, { recursive: true, force: true })
await build({ root: at('.').pathname, logLevel: 'warn', build: { outDir } })

// The folder: a strict policy, and the list of files that the service worker keeps.
const page = await readFile(at('dist/index.html'), 'utf8')
const withPolicy = (html, text) =>
  html.replace('<meta charset="utf-8">', `<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="${text}">`)
await writeFile(at('dist/index.html'), withPolicy(page, policy("'self'", "'self' blob:", "'self'")))
const assets = (await readdir(at('dist/assets'))).map((name) => `assets/${name}`)
const kept = ['./', 'engine.wasm', 'pdf.wasm', 'song.otf', 'gallery.json', 'icon.svg', 'manifest.webmanifest', ...assets]
const hash = createHash('sha256')
for (const name of kept) hash.update(await readFile(at(`dist/${name === './' ? 'index.html' : name}`)))
const worker = await readFile(at('dist/sw.js'), 'utf8')
await writeFile(at('dist/sw.js'), worker.replace('"KEPT"', JSON.stringify(kept)).replace('VERSION', hash.digest('hex').slice(0, 12)))

// The single file: script, style and data inside.
const read = (pattern) => readFile(at(`dist/${assets.find((name) => pattern.test(name))}`), 'utf8')
const [script, style] = [await read(/\.js$/), await read(/\.css$/)]
const inside = script.replace(/<\/script/g, '<\\/script')
const sum = createHash('sha256').update(inside).digest('base64')
const data = async (name) =>
  `<script type="application/octet-stream" id="asset-${name}">${deflateRawSync(await readFile(at(`dist/${name}`)), { level: 9 }).toString('base64')}</script>`
const icon = await readFile(at('dist/icon.svg'))
const datas = await Promise.all(['engine.wasm', 'pdf.wasm', 'song.otf', 'gallery.json'].map(data))
let single = page
  .replace(/<script type="module"[^>]*><\/script>\n?/, '')
  .replace(/<link rel="stylesheet"[^>]*>\n?/, () => `<style>${style}</style>\n`)
  .replace(/<link rel="manifest"[^>]*>\n?/, '')
  .replace(/(<link rel="icon" href=")[^"]*/, `$1data:image/svg+xml;base64,${icon.toString('base64')}`)
  .replace('</body>', () => `${datas.join('\n')}\n<script type="module">${inside}</script>\n</body>`)
single = withPolicy(single, policy(`'sha256-${sum}'`, 'blob:', "'none'"))
await writeFile(at('dist/hodograph.html'), single)
console.log(`dist/index.html and ${kept.length - 1} files; dist/hodograph.html ${(single.length / 1e6).toFixed(1)} MB`)
