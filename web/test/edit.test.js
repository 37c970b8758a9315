// `hodograph edit`: the page served by the program, with a file that it saves and whose changes it follows.
import assert from 'node:assert/strict'
import { spawn } from 'node:child_process'
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { after, test } from 'node:test'
import { dist, drawn, opened, program, text } from './shared.js'

const runs = []
after(() => runs.forEach((run) => run.kill()))

/** Runs `edit` on a file with this text, or a new one; returns its address, the file, and how it is ended. */
async function served(name, content) {
  const file = join(mkdtempSync(join(tmpdir(), 'hodograph-')), name)
  if (content !== undefined) writeFileSync(file, content)
  const run = spawn(program, ['edit', file, '--new', '--no-open', '--page', join(dist, 'hodograph.html')])
  runs.push(run)
  const url = await new Promise((resolve, reject) => {
    let said = ''
    run.stdout.on('data', (bytes) => {
      said += bytes
      if (said.includes('\n')) resolve(said.split('\n')[0])
    })
    run.on('exit', (code) => reject(new Error(`edit ended with ${code}`)))
  })
  return { url, file, end: () => new Promise((resolve) => run.on('exit', resolve) && run.kill('SIGINT')) }
}

const template = (name) => readFileSync(new URL(`../../templates/${name}.json`, import.meta.url), 'utf8')
const holds = (file, wanted) => readFileSync(file, 'utf8') === wanted
const until = async (what, done) => {
  for (let k = 0; k < 100 && !done(); k++) await new Promise((r) => setTimeout(r, 100))
  assert.ok(done(), what)
}
/** Puts a text in place of a part of the editor's text, as typing does. */
const change = (page, part, by) =>
  page.evaluate(([p, b]) => {
    const { editor } = window.hodograph
    const from = editor.text.indexOf(p)
    editor.change({ from, to: from + p.length, insert: b })
  }, [part, by])
const shows = (page, part) => page.waitForFunction((p) => window.hodograph.editor.text.includes(p), part)

test('edit: a change is saved, another editor’s is followed, and where both changed the user decides', async () => {
  const scene = template('crank-rocker').replaceAll('\n', '\r\n')
  const { url, file, end } = await served('my scene.json', scene)
  const { page, context, faults } = await opened(url)
  assert.equal(await text(page), scene.replaceAll('\r\n', '\n'))
  assert.equal(await page.textContent('h1'), 'my scene.json')
  assert.equal(await page.locator('.b-share').count(), 0)
  assert.ok(await page.isDisabled('.b-store'))
  // Saved by the key, with the line ends of the file.
  await change(page, '"Crank-rocker', '"My rocker')
  await page.keyboard.press('Control+s')
  const mine = scene.replace('"Crank-rocker', '"My rocker')
  await until('the text is in the file', () => holds(file, mine))
  await page.waitForSelector('.b-store:disabled')
  // Another editor writes: its text is drawn, and one undo leads back.
  writeFileSync(file, mine.replace('My rocker', 'Theirs'))
  await shows(page, 'Theirs')
  await page.waitForFunction(() => /Theirs/.test(document.title))
  await page.click('.b-undo')
  await shows(page, 'My rocker')
  // Both: nothing is lost without a question.
  await change(page, 'My rocker', 'Mine')
  writeFileSync(file, mine.replace('My rocker', 'Others'))
  await page.waitForSelector('dialog.asks')
  assert.match(await text(page), /Mine/)
  await page.click('.b-keep')
  await page.click('.b-store')
  await until('the text that was kept is in the file', () => holds(file, mine.replace('My rocker', 'Mine')))
  await change(page, 'Mine', 'Mine again')
  writeFileSync(file, mine.replace('My rocker', 'Last'))
  await page.waitForSelector('dialog.asks')
  await page.click('.b-take')
  await shows(page, 'Last')
  await page.waitForSelector('.b-store:disabled')
  // A file that is gone is written again.
  rmSync(file)
  await page.waitForFunction(() => /gone/.test(document.querySelector('.note').textContent))
  await page.keyboard.press('Control+s')
  await until('the file is there again', () => { try { return holds(file, mine.replace('My rocker', 'Last')) } catch { return false } })
  assert.deepEqual(faults, [])
  assert.equal(await end(), 0)
  await page.waitForFunction(() => /has ended/.test(document.querySelector('.note').textContent))
  await context.close()
})

test('edit: a new file, a broken one and a design task are opened', async () => {
  const fresh = await served('new.json')
  const first = await opened(fresh.url, {}, () => {})
  await first.page.waitForSelector('.board')
  await first.page.waitForSelector('.b-store:enabled')
  await first.page.click('.b-store')
  await until('the empty scene is in the file', () => { try { return /"links"/.test(readFileSync(fresh.file, 'utf8')) } catch { return false } })
  assert.deepEqual(first.faults, [])
  await first.context.close()
  await fresh.end()
  const broken = await served('broken.json', '{"links": {"1": ["A"')
  const second = await opened(broken.url, {}, () => {})
  await second.page.waitForSelector('.faults .error')
  assert.equal(await text(second.page), '{"links": {"1": ["A"')
  await second.context.close()
  await broken.end()
  const task = await served('task.json', template('synthesis/body'))
  const third = await opened(task.url)
  await drawn(third.page)
  assert.deepEqual(third.faults, [])
  await third.context.close()
  await task.end()
})
