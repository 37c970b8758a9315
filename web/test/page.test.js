// The page in Chromium. `npm test` after `npm run build`; HODOGRAPH_QUICK=1 takes a part of the templates.
import assert from 'node:assert/strict'
import axe from 'axe-core'
import { spawnSync } from 'node:child_process'
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { TOPICS } from '../topics.js'
import { address, ask, begin, dist, drawn, motionKnown, opened, program, server, text } from './shared.js'

const quick = process.env.HODOGRAPH_QUICK === '1'

/** Runs the program; 4 is its code for answers that do not exist. */
function run(args) {
  const { status, stderr } = spawnSync(program, args, { encoding: 'utf8' })
  assert.ok(status === 0 || status === 4, `${args.join(' ')}: ${status} ${stderr}`)
}

test('opens cold with the shaper, its polygons and its answers', async () => {
  const { page, context, faults } = await opened()
  await page.waitForSelector('.stage[data-count="3"]')
  assert.match(await page.title(), /Shaper/)
  assert.match(await page.textContent('.answers'), /0\.461501 m\/s/)
  assert.match(await page.textContent('.verdict'), /agree to 10⁻¹/)
  assert.deepEqual(faults, [])
  await context.close()
})

test('each template has a topic and a picture', async () => {
  const { page, context } = await opened()
  const { templates } = await ask(page, { do: 'templates' })
  const topics = TOPICS.flatMap((t) => t.names)
  assert.deepEqual(topics.toSorted(), templates.map((t) => t.name).toSorted())
  await page.click('.b-gallery')
  await page.fill('.gallery input', 'geneva')
  assert.equal(await page.locator('.card').count(), 0)
  await page.fill('.gallery input', '凸轮')
  assert.ok((await page.locator('.card').count()) >= 5)
  await page.fill('.gallery input', 'whitworth')
  await page.click('.card')
  await page.waitForFunction(() => /Whitworth/.test(document.title))
  await context.close()
})

test('every template is drawn, byte for byte as by the program', async () => {
  const { page, context, faults } = await opened()
  const { templates } = await ask(page, { do: 'templates' })
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const differ = []
  for (const { name } of templates.filter((_, k) => !quick || k % 8 === 0)) {
    const { text } = await ask(page, { do: 'template', name })
    const file = join(folder, `${name}.json`)
    writeFileSync(file, text)
    for (const lang of quick ? ['en'] : ['en', 'zh']) {
      const { handle } = await ask(page, { do: 'open', text, lang })
      const { figures } = await ask(page, { do: 'frame', handle, lang })
      await ask(page, { do: 'close', handle })
      run(['draw', file, '-o', `${folder}/`, '--format', 'svg', '--lang', lang])
      for (const page of figures) {
        const out = join(folder, `${name}${page.name ? `-${page.name}` : ''}.svg`)
        if (page.svg !== readFileSync(out, 'utf8')) differ.push(`${name}.${page.name}.${lang}`)
      }
    }
  }
  assert.deepEqual(differ, [])
  assert.deepEqual(faults, [])
  await context.close()
})

test('the mechanism is dragged, polygons and answers follow, and undo gives the first bytes again', async () => {
  const { page, context } = await opened()
  await motionKnown(page)
  const before = [await text(page), await page.textContent('.answers'), await page.locator('.pane[data-figure="velocity"] svg').innerHTML()]
  const pin = await page.locator('.pane[data-figure="mechanism"] [id$="mechanism-pin-A"]').first().boundingBox()
  await page.mouse.move(pin.x + pin.width / 2, pin.y + pin.height / 2)
  await page.mouse.down()
  await page.mouse.move(pin.x + 25, pin.y + 12, { steps: 4 })
  await page.mouse.move(pin.x + 30, pin.y + 30, { steps: 4 })
  await page.waitForFunction((was) => document.querySelector('.answers').textContent !== was, before[1])
  await page.mouse.up()
  await page.waitForFunction((was) => window.hodograph.editor.text !== was, before[0])
  await page.waitForFunction(() => window.hodograph.travel === 0)
  assert.notEqual(await page.locator('.pane[data-figure="velocity"] svg').innerHTML(), before[2])
  await page.click('.b-undo')
  await page.waitForFunction((was) => document.querySelector('.answers').textContent === was, before[1])
  assert.equal(await text(page), before[0])
  await page.waitForFunction((was) => document.querySelector('.pane[data-figure="velocity"] svg').innerHTML === was, before[2])
  await context.close()
})

test('answers are hidden while they are to be predicted, and each is shown on a click', async () => {
  const { page, context } = await opened()
  await page.click('.b-predict')
  assert.doesNotMatch(await page.textContent('.answers'), /0\.461501|agree/)
  await page.click('.answers .reveal')
  assert.match(await page.textContent('.answers'), /0\.461501/)
  assert.doesNotMatch(await page.textContent('.answers'), /3\.15661/)
  await page.click('.b-predict')
  assert.match(await page.textContent('.answers'), /3\.15661.*agree/)
  await context.close()
})

test('it plays, and the answers change', async () => {
  const { page, context } = await opened()
  await motionKnown(page)
  const first = await page.textContent('.answers')
  await page.click('.play')
  await page.waitForFunction((was) => document.querySelector('.answers').textContent !== was, first)
  await page.click('.play')
  await context.close()
})

test('playing and dragging draw frame after frame', async (t) => {
  const { page, context } = await opened()
  await motionKnown(page)
  // Drawings and frames of the screen in a second; the machine may have other work, so that only a standstill fails.
  const counted = (seconds) => page.evaluate(async (seconds) => {
    const { engine } = window.hodograph
    const ask = engine.ask
    let drawn = 0
    engine.ask = async function (message) {
      const answer = await ask.call(this, message)
      if (message.do === 'move') drawn++
      return answer
    }
    let frames = 0
    const until = performance.now() + 1000 * seconds
    while (performance.now() < until) {
      await new Promise(requestAnimationFrame)
      frames++
    }
    engine.ask = ask
    return { drawn: drawn / seconds, frames: frames / seconds }
  }, seconds)
  const seconds = quick ? 2 : 10
  await page.click('.play')
  const played = await counted(seconds)
  await page.click('.play')
  await page.waitForFunction(() => window.hodograph.travel === 0 && !window.hodograph.engine.busy)
  await motionKnown(page)
  const pin = await page.locator('.pane[data-figure="mechanism"] [id$="mechanism-pin-A"]').first().boundingBox()
  await page.mouse.move(pin.x + pin.width / 2, pin.y + pin.height / 2)
  await page.mouse.down()
  const dragging = counted(seconds)
  let done = false
  void dragging.then(() => { done = true })
  for (let k = 0; !done; k++) await page.mouse.move(pin.x + 30 * Math.sin(k / 20), pin.y + 30 * Math.cos(k / 20))
  const dragged = await dragging
  await page.mouse.up()
  const told = ({ drawn, frames }) => `${drawn.toFixed(1)} drawings of ${frames.toFixed(1)} frames a second`
  t.diagnostic(`playing: ${told(played)}; dragging: ${told(dragged)}`)
  assert.ok(played.drawn >= 5 && dragged.drawn >= 5, `${told(played)}; ${told(dragged)}`)
  await context.close()
})

test('an error is underlined at its place, with its help', async () => {
  const { page, context } = await opened()
  const scene = (await text(page)).replace('"mm"', '"mm"')
  await begin(page, scene.replace('"find"', '"fiind"'))
  await page.waitForSelector('.cm-lintRange-error')
  assert.match(await page.textContent('.cm-lintRange-error'), /fiind/)
  assert.match(await page.textContent('.faults'), /find/)
  assert.equal(await page.locator('.stage.stale').count(), 1)
  await begin(page, scene)
  await page.waitForSelector('.stage:not(.stale)')
  assert.equal(await page.locator('.cm-lintRange-error').count(), 0)
  await context.close()
})

test('keys and names are completed', async () => {
  const { page, context } = await opened()
  await page.waitForFunction(() => window.hodograph.schemas !== null)
  await page.click('.cm-content')
  await page.keyboard.press('Control+Home')
  await page.keyboard.press('ArrowRight')
  await page.keyboard.type('"fric')
  await page.waitForSelector('.cm-tooltip-autocomplete')
  assert.match(await page.textContent('.cm-tooltip-autocomplete'), /friction/)
  await context.close()
})

test('a link holds the scene', async () => {
  const { page, context } = await opened()
  const scene = (await text(page)).replace('{', '{\n ')
  await begin(page, scene)
  await page.click('.b-share')
  await page.waitForFunction(() => location.hash.length > 100)
  const link = page.url()
  await context.close()
  const other = await opened(link)
  assert.equal(await text(other.page), scene)
  await other.context.close()
})

test('works with the network cut', async () => {
  const { page, context } = await opened()
  await page.evaluate(() => navigator.serviceWorker.ready)
  await page.waitForFunction(async () => (await Promise.all((await caches.keys()).map(async (k) => (await (await caches.open(k)).keys()).length))).some((n) => n >= 6))
  await context.setOffline(true)
  server.closeAllConnections()
  await page.reload()
  await drawn(page)
  await page.click('.b-other')
  await page.waitForFunction(() => document.documentElement.lang === 'zh-CN' && /牛头刨床/.test(document.title))
  await context.close()
})

test('survives a trap in the engine', async () => {
  const { page, context } = await opened()
  const told = await page.evaluate(async () => {
    const { handle } = window.hodograph.opened
    return window.hodograph.engine.ask({ do: 'trap', handle }).then(() => 'no trap', (fault) => fault.trap)
  })
  assert.match(told, /unreachable/i)
  assert.match(await page.textContent('.note'), /started again/)
  await begin(page, (await ask(page, { do: 'template', name: 'crank-rocker' })).text)
  await page.waitForFunction(() => /Crank-rocker/.test(document.title))
  await context.close()
})

/** Begins with a template; waits for its drawing. */
async function template(page, name) {
  const { text } = await ask(page, { do: 'template', name })
  await begin(page, text)
  await page.waitForFunction((t) => window.hodograph.opened && window.hodograph.editor.text === t && !window.hodograph.engine.busy, text)
  return text
}

/** The files of a form, as they would be saved: bytes. */
const filesOf = (page, form, of) => page.evaluate(async ([form, of]) => {
  window.hodograph.name = 'scene'
  const files = await window.hodograph.files(form, of)
  return files.map(({ name, text }) => ({ name, bytes: [...(typeof text === 'string' ? new TextEncoder().encode(text) : text)] }))
}, [form, of])

/** The saved files that differ from those that the program writes under the same names. */
async function differing(page, folder, form, of, args) {
  const made = await filesOf(page, form, of)
  const out = join(folder, made[0].name)
  run([...args, out])
  return made.filter(({ name, bytes }) => !Buffer.from(bytes).equals(readFileSync(join(folder, name)))).map(({ name }) => `${form} ${of ?? ''} ${name}`)
}

test('documents are those of the program', async () => {
  const { page, context } = await opened()
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'told.json')
  writeFileSync(file, await template(page, 'crank-rocker'))
  const differ = []
  for (const [form, of, command, ...more] of [
    ['html', 'problem', 'worksheet', '--problem-only'], ['html', 'solution', 'worksheet', '--solution'], ['md', , 'worksheet'], ['typ', , 'worksheet'],
    ['html', 'questions', 'worksheet', '--questions'], ['html', 'table', 'worksheet', '--solution', '--table', '12'],
    ['pdf', 'questions', 'worksheet', '--questions'], ['pdf', 'table', 'worksheet', '--solution', '--table', '12'], ['pdf', 'frame', 'worksheet', '--frame'],
    ['lesson', , 'lesson'], ['csv', , 'sweep'],
  ]) differ.push(...await differing(page, folder, form, of, [command, file, '--lang', 'en', ...more, '-o']))
  assert.deepEqual(differ, [])
  await context.close()
})

test('lessons by a method are those of the program', async () => {
  const { page, context } = await opened()
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'told.json')
  const differ = []
  const all = [['crank-rocker', 'centres'], ['cam-offset-roller', 'cam'], ['planetary-gear', 'trains'], ['slider-crank', 'loops'], ['shaper', 'composite'], ['crank-rocker', 'curvature']]
  for (const [name, method] of quick ? all.slice(0, 3) : all) {
    writeFileSync(file, await template(page, name))
    differ.push(...await differing(page, folder, 'lesson', method, ['lesson', file, '--lang', 'en', '--method', method, '-o']))
  }
  assert.deepEqual(differ, [])
  const refused = await page.evaluate(() => window.hodograph.files('lesson', 'cam').then(() => null, (fault) => fault.diagnostics[0].message))
  assert.ok(quick || (refused.en && refused.zh), 'a method that the scene does not have')
  await context.close()
})

test('files of other programs are those of the program', async () => {
  const { page, context } = await opened()
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'told.json')
  writeFileSync(file, await template(page, 'crank-rocker'))
  const differ = []
  for (const form of ['dxf', 'tikz', 'ggb', 'pylinkage', 'pylinkage-json', 'pmks']) {
    differ.push(...await differing(page, folder, form, undefined, ['export', file, '--lang', 'en', '-o']))
  }
  await page.evaluate(() => { window.hodograph.tab = 'centres' })
  for (const form of ['dxf', 'tikz']) {
    differ.push(...await differing(page, folder, form, undefined, ['export', file, '--lang', 'en', '--figure', 'centres', '-o']))
  }
  await page.evaluate(() => { window.hodograph.tab = 'live' })
  writeFileSync(file, await template(page, 'cam-offset-roller'))
  for (const form of ['cam-dxf', 'cam-csv']) differ.push(...await differing(page, folder, form, undefined, ['cam', file, '--profile']))
  assert.deepEqual(differ, [])
  await page.click('.menu summary')
  await page.click('[data-form="ggb"]')
  await page.waitForFunction(() => /凸轮|cams/.test(document.querySelector('.note').textContent))
  await context.close()
})

test('the motion cycle and the least base circle are those of the program', async () => {
  const { page, context } = await opened()
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'scene.json')
  writeFileSync(file, await template(page, 'cam-offset-roller'))
  const told = (...args) => spawnSync(program, args, { encoding: 'utf8' }).stdout
  const shown = (text) => page.waitForFunction((t) => document.querySelector('pre.report')?.textContent === t, text)
  await page.click('[data-tab="cycle"]')
  await shown(told('cycle', file, '--lang', 'en'))
  await page.selectOption('.report select', 'polar')
  const drawn = told('cycle', file, '--lang', 'en', '--form', 'polar', '-o', '-', '--format', 'svg')
  await page.waitForFunction(() => document.querySelector('.report select')?.value === 'polar')
  const [cycle] = await filesOf(page, 'svg')
  assert.equal(Buffer.from(cycle.bytes).toString(), drawn)
  await page.click('[data-tab="least"]')
  await shown(told('cam', file, '--lang', 'en', '--alpha', '30deg'))
  await page.fill('.report input', '25')
  await page.press('.report input', 'Enter')
  await shown(told('cam', file, '--lang', 'en', '--alpha', '25deg'))
  run(['cam', file, '--lang', 'en', '--alpha', '25deg', '-o', folder, '--format', 'svg'])
  const [least] = await filesOf(page, 'svg')
  assert.equal(Buffer.from(least.bytes).toString(), readFileSync(join(folder, 'scene-cam-alpha.svg'), 'utf8'))
  await page.click('[data-tab="live"]')
  await page.waitForSelector('.stage[data-tab="live"] .pane svg')
  assert.equal(await page.locator('.report').count(), 0)
  await context.close()
})

test('limits and mobility are told as by the program', async () => {
  const { page, context } = await opened()
  await motionKnown(page)
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'shaper.json')
  writeFileSync(file, await text(page))
  for (const lang of ['en', 'zh']) {
    for (const of of ['limits', 'mobility']) {
      await page.click(`[data-tab="${of}"]`)
      const { stdout } = spawnSync(program, [of, file, '--lang', lang], { encoding: 'utf8' })
      await page.waitForFunction((t) => document.querySelector('pre.report')?.textContent === t, stdout)
    }
    await page.click('[data-tab="live"]')
    await page.waitForSelector('.pane svg')
    assert.equal(await page.locator('.report').count(), 0)
    if (lang === 'en') await page.click('.b-other')
    await motionKnown(page)
  }
  await context.close()
})

test('figures and worksheets as PDF are those of the program', async () => {
  const { page, context, faults } = await opened()
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const differ = []
  for (const name of quick ? ['shaper'] : ['shaper', 'cam-offset-roller', 'planetary-gear', 'excavator', 'crank-rocker']) {
    await begin(page, (await ask(page, { do: 'template', name })).text)
    const file = join(folder, `${name}.json`)
    writeFileSync(file, await text(page))
    await page.waitForFunction((t) => window.hodograph.opened && window.hodograph.editor.text === t && !window.hodograph.engine.busy, await text(page))
    for (const lang of quick ? ['en'] : ['en', 'zh']) {
      await page.evaluate((l) => window.hodograph.setLang(l), lang)
      await page.waitForFunction(() => !window.hodograph.engine.busy)
      const runs = [['live', undefined, 'draw'], ['plates', undefined, 'draw', '--figure', 'plates'], ['curves', undefined, 'curves'],
        ['live', 'problem', 'worksheet', '--problem-only'], ['live', 'solution', 'worksheet', '--solution']]
      for (const [tab, sides, command, ...more] of runs) {
        const bytes = await page.evaluate(async ([t, s]) => {
          window.hodograph.tab = t
          const [file] = await window.hodograph.files('pdf', s)
          window.hodograph.tab = 'live'
          return [...file.text]
        }, [tab, sides])
        const out = join(folder, 'out.pdf')
        run([command, file, '-o', out, '--lang', lang, ...more])
        if (!Buffer.from(bytes).equals(readFileSync(out))) differ.push(`${name} ${lang} ${command} ${tab} ${sides ?? ''}`)
      }
    }
  }
  assert.deepEqual(differ, [])
  assert.deepEqual(faults, [])
  await context.close()
})

test('a figure is saved as PNG, at 300 dots per inch', async () => {
  const { page, context } = await opened()
  const { figures: [sheet] } = await page.evaluate(() => window.hodograph.engine.ask({ do: 'frame', handle: window.hodograph.opened.handle, lang: 'en' }))
  const [width, height] = ['width', 'height'].map((side) => Number(new RegExp(` ${side}="([\\d.]+)mm"`).exec(sheet.svg)[1]))
  const download = page.waitForEvent('download')
  await page.click('.menu summary')
  await page.click('[data-form="png"]')
  const bytes = readFileSync(await (await download).path())
  assert.equal(bytes.toString('latin1', 1, 4), 'PNG')
  const [x, y] = [16, 20].map((at) => bytes.readUInt32BE(at))
  assert.deepEqual([x, y], [width, height].map((mm) => Math.round((mm / 25.4) * 300)))
  await context.close()
})

test('the single file opens from a disk', async () => {
  const { page, context, faults } = await opened(`file://${join(dist, 'hodograph.html')}`)
  assert.match(await page.textContent('.answers'), /0\.461501 m\/s/)
  await page.click('.b-other')
  await page.waitForFunction(() => /牛头刨床/.test(document.title))
  await page.click('.b-gallery')
  assert.ok((await page.locator('.card').count()) > 60)
  assert.deepEqual(faults, [])
  await context.close()
})

test('a lesson with the engine inside is drawn anew for other lengths', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'hodograph-'))
  const file = join(folder, 'lesson.html')
  run(['lesson', join(dist, '../../templates/crank-rocker.json'), '--live', '--page', join(dist, 'hodograph.html'), '--lang', 'zh', '-o', file])
  const { page, context, faults } = await opened(`file://${file}`, {}, (page) => page.waitForSelector('.stage[data-tab="steps"] .pane svg'))
  assert.match(await page.title(), /曲柄摇杆/)
  await page.click('.transport button:last-child')
  await page.waitForFunction(() => /2 \//.test(document.querySelector('.reading').textContent))
  const before = await page.locator('.pane svg').innerHTML()
  assert.ok(await page.locator('.text').isHidden())
  await page.fill('.given [id="given-parameters-l_AB"]', '90')
  await page.press('.given [id="given-parameters-l_AB"]', 'Enter')
  await page.waitForFunction((was) => document.querySelector('.pane svg').innerHTML !== was, before)
  assert.match(await page.textContent('.reading'), /2 \//)
  const { stdout } = spawnSync(program, ['solve', join(dist, '../../templates/crank-rocker.json'), '--set', 'l_AB=90'], { encoding: 'utf8' })
  const omega = /omega_3 *= *([\d.]+)/.exec(stdout)[1]
  await page.waitForFunction((is) => document.querySelector('.answers').textContent.includes(is), omega)
  assert.equal(await page.inputValue('.given [id="given-parameters-l_AB"]'), '90 mm')
  await page.fill('.given [id="given-parameters-l_AB"]', 'ninety')
  await page.press('.given [id="given-parameters-l_AB"]', 'Enter')
  await page.waitForSelector('.given [aria-invalid="true"]')
  await page.click('.b-undo')
  await page.waitForFunction((was) => document.querySelector('.pane svg').innerHTML === was, before)
  assert.deepEqual(faults, [])
  await context.close()
})

test('no rule of axe is broken: drawing, tools, gallery, dark, in both languages', async () => {
  const { page, context } = await opened()
  await page.evaluate(axe.source)
  const broken = async (where) => {
    const { violations } = await page.evaluate(() => window.axe.run())
    return violations.map((v) => `${where}: ${v.id} ${v.nodes.map((n) => n.target.join(' ') + ' ' + n.html.slice(0, 90)).slice(0, 3)}`)
  }
  await motionKnown(page)
  const all = await broken('drawing')
  await page.click('.b-build')
  await page.waitForSelector('.board')
  all.push(...(await broken('tools')))
  await page.click('.b-build')
  await page.click('.b-theme')
  await page.click('.b-other')
  await page.waitForFunction(() => document.documentElement.lang === 'zh-CN')
  await drawn(page)
  all.push(...(await broken('dark')))
  await page.click('.b-gallery')
  await page.waitForSelector('.card')
  all.push(...(await broken('gallery')))
  assert.deepEqual(all, [])
  await context.close()
})

test('on a phone nothing is wider than the screen', async () => {
  const { page, context } = await opened(address, { viewport: { width: 390, height: 844 }, hasTouch: true })
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390)
  // The whole list of what is saved can be reached.
  await page.click('.menu summary')
  const last = page.locator('.menu [data-form]').last()
  await last.scrollIntoViewIfNeeded()
  const box = await last.boundingBox()
  assert.ok(await page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.dataset.form, [box.x + 5, box.y + box.height / 2]) === 'scene')
  await context.close()
})
