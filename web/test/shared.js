// What the tests of the page share: a server of the built page, the browser, and what a user reads and does.
import { readFileSync } from 'node:fs'
import { createServer } from 'node:http'
import { extname, join } from 'node:path'
import { after, before } from 'node:test'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'

export const program = process.env.HODOGRAPH ?? fileURLToPath(new URL('../../target/debug/hodograph', import.meta.url))
export const dist = fileURLToPath(new URL('../dist/', import.meta.url))
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.json': 'application/json', '.svg': 'image/svg+xml' }

export let server, address
let browser

before(async () => {
  server = createServer((request, response) => {
    const name = new URL(request.url, 'http://x').pathname.replace(/\/$/, '/index.html')
    try {
      const body = readFileSync(join(dist, name))
      response.writeHead(200, { 'content-type': TYPES[extname(name)] ?? 'application/octet-stream' }).end(body)
    } catch {
      response.writeHead(404).end()
    }
  })
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve))
  address = `http://127.0.0.1:${server.address().port}/`
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  })
})

after(async () => {
  await browser?.close()
  server?.close()
})

/** A new page without faults in its console, opened and drawn. */
export async function opened(url = address, options = {}, ready = drawn) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, locale: 'en-GB', ...options })
  const page = await context.newPage()
  page.setDefaultTimeout(60_000)
  const faults = []
  page.on('console', (m) => m.type() === 'error' && faults.push(m.text()))
  page.on('pageerror', (e) => faults.push(String(e)))
  await page.goto(url)
  await ready(page)
  return { page, context, faults }
}

export const drawn = (page) => page.waitForSelector('.stage:not(.stale) .pane svg')
export const text = (page) => page.evaluate(() => window.hodograph.editor.text)
export const begin = (page, scene) => page.evaluate((t) => window.hodograph.editor.begin(t), scene)
export const ask = (page, message) => page.evaluate((m) => window.hodograph.engine.ask(m), message)
export const motionKnown = (page) => page.waitForFunction(() => window.hodograph.course?.can)
