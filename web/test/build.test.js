// Building with the mouse, in Chromium. `node --test test/build.test.js` after `npm run build`; HODOGRAPH_QUICK=1 leaves out the longest.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { address, ask, begin, motionKnown, opened, text } from './shared.js'

/** The page with an empty scene, and the hand of its user: places are in mm of the plane. */
async function empty(options) {
  const all = await opened(address, options)
  const { page } = all
  await page.click('.b-create')
  return { ...all, ...hand(page) }
}

function hand(page) {
  /** All acts are done, and the board shows the text. */
  const still = () => page.evaluate(async () => {
    const { builder, editor, engine } = window.hodograph
    do {
      await new Promise((done) => setTimeout(done, 20))
      await builder.queue
      // A value that is typed is written when the engine has read it.
      while (engine.busy) await new Promise((r) => setTimeout(r, 5))
    } while (builder.text !== editor.text || builder.candidate !== null || builder.trying)
  })
  const pixel = async (x, y) => {
    await still()
    const box = await page.locator('.board').boundingBox()
    const view = await page.evaluate(() => window.hodograph.builder.board.view)
    return [box.x + view.x + (x / 1000) * view.scale, box.y + view.y - (y / 1000) * view.scale]
  }
  const place = (name) => page.evaluate((n) => window.hodograph.builder.board.outline.places.get(n).map((v) => v * 1000), name)
  const click = async (x, y) => page.mouse.click(...(await pixel(x, y)))
  return {
    still,
    pixel,
    place,
    tool: (name) => page.click(`.t-${name}`),
    click,
    /** Clicks a joint where it is now. */
    joint: async (name) => {
      await still()
      await click(...(await place(name)))
    },
    drag: async (name, x, y, options = {}) => {
      await still()
      const from = await pixel(...(await place(name)))
      const to = await pixel(x, y)
      if (options.alt) await page.keyboard.down('Alt')
      await page.mouse.move(...from)
      await page.mouse.down()
      await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 })
      await page.mouse.move(...to, { steps: 3 })
      await page.mouse.up()
      if (options.alt) await page.keyboard.up('Alt')
      await still()
    },
    /** Types a value into the field of a quantity. */
    type: async (path, value) => {
      await still()
      const field = page.locator(`.inspector [data-path="${path}"]`)
      await field.fill(value)
      await field.press('Tab')
      await still()
    },
    find: async (...finds) => {
      for (const find of finds) {
        await still()
        await page.click(`.chip[data-find="${find}"]`)
      }
      await still()
    },
    answers: async () => {
      await still()
      await page.waitForFunction(() => window.hodograph.builder.page !== null)
      const { handle } = await page.evaluate(() => window.hodograph.opened)
      const { answers } = await ask(page, { do: 'frame', handle, what: [], answers: true })
      return Object.fromEntries(answers.map((a) => [a.find, a.text]))
    },
    undo: async () => {
      await still()
      await page.click('.b-undo')
      await still()
    },
  }
}

/** The answers of a template. */
async function template(page, name) {
  const told = await ask(page, { do: 'template', name })
  const { handle } = await ask(page, { do: 'open', text: told.text })
  const { answers } = await ask(page, { do: 'frame', handle, what: [], answers: true })
  await ask(page, { do: 'close', handle })
  return Object.fromEntries(answers.map((a) => [a.find, a.text]))
}

/** Undoes everything; the bytes are those of the beginning. */
async function undone(page, { undo }, first) {
  while (await page.locator('.b-undo:not([disabled])').count()) await undo()
  assert.equal(await text(page), first)
}

const quick = process.env.HODOGRAPH_QUICK === '1'
const EMPTY = '{\n  "links": {"0": []},\n  "ground": "0"\n}\n'

test('a crank-rocker is built from nothing, and has the answers of the template', async () => {
  const { page, context, faults, ...h } = await empty()
  assert.equal(await text(page), EMPTY)
  await h.click(0, 0)
  await h.click(300, 0)
  await h.tool('link')
  for (const at of [[0, 0], [50, 90], [50, 90], [240, 200], [240, 200], [300, 0]]) await h.click(...at)
  await h.tool('node')
  await h.click(145, 145)
  assert.match(await page.textContent('.faults'), /driver/)
  await h.tool('driver')
  await h.click(25, 45)
  // The letters of the template: here B is the pivot, C and D are the next joints.
  for (const [old, now] of [['B', 'Z'], ['C', 'B'], ['D', 'C'], ['Z', 'D']]) {
    await h.joint(old)
    await h.type('name', now)
  }
  await h.joint('B')
  await h.type('lengths.AB', '100')
  await h.type('lengths.BC', '250 mm')
  await h.joint('C')
  await h.type('lengths.DC', '200 mm')
  await h.joint('E')
  await h.type('points.E.x', '125 mm')
  await h.type('points.E.y', '100')
  await h.find('v_E', 'a_E')
  await h.joint('C')
  await h.find('v_C', 'a_C')
  await h.click(...(await h.place('A')).map((v, k) => v + [15, 26][k]))
  await h.type('driver.angle', '60 deg')
  await h.type('driver.omega', '10')
  for (const [p, q, link] of [['B', 'C', '2'], ['D', 'C', '3']]) {
    const [a, b] = [await h.place(p), await h.place(q)]
    await h.click(a[0] * 0.7 + b[0] * 0.3, a[1] * 0.7 + b[1] * 0.3)
    await h.find(`omega_${link}`, `alpha_${link}`)
  }
  assert.deepEqual(await h.answers(), await template(page, 'crank-rocker'))
  await undone(page, h, EMPTY)
  assert.deepEqual(faults, [])
  await context.close()
})

test('an offset slider-crank is built from nothing, and has the answers of the template', async () => {
  const { page, context, faults, ...h } = await empty()
  await h.click(0, 0)
  await page.keyboard.press('l')
  for (const at of [[0, 0], [60, 80], [60, 80], [300, -60]]) await h.click(...at)
  await page.keyboard.press('s')
  await h.click(300, -60)
  await h.click(350, -60)
  await page.keyboard.press('d')
  await h.click(30, 40)
  await h.type('driver.angle', '50')
  await h.type('driver.omega', '20 rad/s')
  await h.type('lengths.AB', '100')
  await h.joint('C')
  await h.type('lengths.BC', '280')
  await h.type('guides.0.offset', '-60 mm')
  await h.find('v_C', 'a_C')
  await page.keyboard.press('n')
  const [b, c] = [await h.place('B'), await h.place('C')]
  await h.click(b[0] * 0.7 + c[0] * 0.3, b[1] * 0.7 + c[1] * 0.3)
  await h.type('points.D.x', '280 mm/3')
  await h.type('points.D.y', '0')
  await h.type('name', 'S')
  await h.find('v_S', 'a_S')
  await page.keyboard.press('v')
  await h.click(b[0] * 0.5 + c[0] * 0.5, b[1] * 0.5 + c[1] * 0.5)
  await h.find('omega_2', 'alpha_2')
  assert.deepEqual(await h.answers(), await template(page, 'offset-slider-crank'))
  await undone(page, h, EMPTY)
  assert.deepEqual(faults, [])
  await context.close()
})

test('a geared five-bar is built from nothing, and has the answers of the template', { skip: quick }, async () => {
  const { page, context, faults, ...h } = await empty()
  await h.click(0, 0)
  await h.click(90, 0)
  await page.keyboard.press('l')
  for (const at of [[0, 0], [20, 40], [20, 40], [30, 120], [30, 120], [80, 70], [80, 70], [90, 0]]) await h.click(...at)
  await page.keyboard.press('g')
  await h.click(10, 20)
  await h.click(85, 35)
  await page.keyboard.press('d')
  await h.click(10, 20)
  await h.type('driver.angle', '45')
  await h.type('driver.omega', '10')
  await h.type('lengths.AC', '25 mm')
  await h.type('gears.0.teeth.0', '20')
  await h.type('gears.0.teeth.1', '40')
  await h.type('gears.0.phase', '150 deg')
  await h.joint('D')
  await h.type('lengths.CD', '80')
  await h.type('lengths.DE', '90')
  await h.joint('E')
  await h.type('lengths.BE', '40')
  // Names as in the template.
  for (const [old, now] of [['D', 'Z'], ['E', 'D'], ['B', 'E'], ['C', 'B'], ['Z', 'C']]) {
    await h.joint(old)
    await h.type('name', now)
  }
  for (const [p, q, old, now] of [['E', 'D', '4', '5'], ['D', 'C', '3', '4'], ['C', 'B', '2', '3'], ['B', 'A', '1', '2']]) {
    const [a, b] = [await h.place(p), await h.place(q)]
    await h.click((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    assert.equal(await page.inputValue('.inspector .name'), old)
    await h.type('name', now)
    if (now === '5') await h.find('omega_5')
    if (now === '4' || now === '3') await h.find(`omega_${now}`, `alpha_${now}`)
  }
  await h.joint('C')
  await h.find('v_C', 'a_C')
  assert.deepEqual(await h.answers(), await template(page, 'geared-five-bar'))
  await undone(page, h, EMPTY)
  assert.deepEqual(faults, [])
  await context.close()
})

/** The strings and numbers of a text by their paths. */
function leaves(json, path = '') {
  return json !== null && typeof json === 'object' ? Object.entries(json).flatMap(([k, v]) => leaves(v, `${path}/${k}`)) : [[path, json]]
}
function changed(before, after) {
  const old = new Map(leaves(JSON.parse(before)))
  const now = leaves(JSON.parse(after))
  assert.deepEqual(now.map(([k]) => k), [...old.keys()])
  return now.filter(([k, v]) => old.get(k) !== v).map(([k]) => k)
}

/** A template with the tools. */
async function built(name) {
  const all = await opened()
  const { page } = all
  await begin(page, (await ask(page, { do: 'template', name })).text)
  await page.click('.b-build')
  return { ...all, ...hand(page) }
}

test('dragging a joint rewrites its lengths or coordinates, at their parameters, and nothing else', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  await h.still()
  const first = await text(page)
  const [d, e] = [await h.place('D'), await h.place('E')]
  await h.drag('C', 260, 170)
  const second = await text(page)
  assert.deepEqual(changed(first, second), ['/parameters/l_BC', '/parameters/l_CD'])
  const c = await h.place('C')
  assert.ok(Math.hypot(c[0] - 260, c[1] - 170) < 2, `${c}`)
  assert.deepEqual(await h.place('D'), d)
  // The crank pin: its angle follows, so that the rocker stays.
  await h.drag('B', 70, 60)
  const third = await text(page)
  assert.deepEqual(changed(second, third), ['/parameters/l_AB', '/parameters/l_BC', '/parameters/phi_1'])
  const moved = await h.place('C')
  assert.ok(Math.hypot(moved[0] - c[0], moved[1] - c[1]) < 3, `${moved} ${c}`)
  const f = await h.place('E')
  await h.drag('E', f[0] + 30, f[1] - 20)
  assert.deepEqual(changed(third, await text(page)), ['/parameters/x_E', '/parameters/y_E'])
  assert.notDeepEqual(await h.place('E'), e)
  for (let k = 0; k < 3; k++) await h.undo()
  assert.equal(await text(page), first)
  // With Alt the mechanism moves, and only the driver's angle is written.
  await page.waitForFunction(() => window.hodograph.course?.can)
  const a = await h.place('B')
  await h.drag('B', a[0] - 30, a[1] + 12, { alt: true })
  await page.waitForFunction((was) => window.hodograph.editor.text !== was, first)
  await h.still()
  assert.deepEqual(changed(first, await text(page)), ['/parameters/phi_1'])
  assert.deepEqual(faults, [])
  await context.close()
})

test('a joint that crosses the line of its side, a pin with its guide, and a gear keep the others in place', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  const first = await text(page)
  await h.drag('C', 200, -120)
  assert.match(await text(page), /right of BD/)
  const c = await h.place('C')
  assert.ok(Math.hypot(c[0] - 200, c[1] + 120) < 3, `${c}`)
  await begin(page, (await ask(page, { do: 'template', name: 'offset-slider-crank' })).text)
  await h.still()
  const slider = await text(page)
  await h.drag('C', 300, -90)
  assert.deepEqual(changed(slider, await text(page)), ['/parameters/e', '/lengths/BC'])
  await begin(page, (await ask(page, { do: 'template', name: 'geared-five-bar' })).text)
  await h.still()
  const [gears, was] = [await text(page), await h.place('C')]
  await h.drag('D', 85, 60)
  assert.deepEqual(changed(gears, await text(page)), ['/parameters/l_CD', '/parameters/l_DE', '/parameters/delta'])
  const now = await h.place('C')
  assert.ok(Math.hypot(now[0] - was[0], now[1] - was[1]) < 3, `${now} ${was}`)
  assert.notEqual(first, slider)
  assert.deepEqual(faults, [])
  await context.close()
})

test('a joint whose place is stated twice is never dragged into a text that the engine refuses', async () => {
  const { page, context, faults } = await opened()
  const { drag, still, place } = hand(page)
  const answered = []
  for (const [name, joint, by, moves] of [['third-crank', 'C', [60, 40], false], ['eccentric-three-ways', 'A', [20, 15], false], ['lathe', 'O', [10, 20], false], ['ships', 'O', [8000, 12000], true]]) {
    await begin(page, (await ask(page, { do: 'template', name })).text)
    await page.waitForFunction((t) => window.hodograph.opened && window.hodograph.editor.text === t && !window.hodograph.engine.busy, await text(page))
    await page.evaluate(() => window.hodograph.builder.on || window.hodograph.build(true))
    await still()
    const before = await text(page)
    const [x, y] = await place(joint)
    await drag(joint, x + by[0], y + by[1])
    const after = await text(page)
    const told = await page.evaluate((t) => window.hodograph.engine.ask({ do: 'open', text: t }).then(() => 'accepted', (fault) => fault.message), after)
    answered.push([name, told, !moves || after !== before])
  }
  assert.deepEqual(answered, ['third-crank', 'eccentric-three-ways', 'lathe', 'ships'].map((name) => [name, 'accepted', true]))
  assert.deepEqual(faults, [])
  await context.close()
})

test('a value is typed with its unit; what is none is refused', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  await h.still()
  const first = await text(page)
  await h.joint('B')
  await h.type('lengths.AB', '12 cm')
  assert.deepEqual(changed(first, await text(page)), ['/parameters/l_AB'])
  assert.match(await text(page), /"l_AB": "12 cm"/)
  await page.click('.screen [id$="mechanism-label-rotation-1"]')
  assert.equal(await page.evaluate(() => document.activeElement.dataset.path), 'driver.omega')
  await h.joint('B')
  await h.type('lengths.AB', 'long')
  assert.match(await text(page), /"l_AB": "12 cm"/)
  assert.equal(await page.getAttribute('[data-path="lengths.AB"]', 'aria-invalid'), 'true')
  await h.undo()
  assert.equal(await text(page), first)
  assert.deepEqual(faults, [])
  await context.close()
})

test('a link that is deleted takes with it what refers to it, and the rest is drawn as a sketch', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  await h.still()
  const first = await text(page)
  await h.tool('delete')
  const [c, d] = [await h.place('C'), await h.place('D')]
  await h.click((c[0] + d[0]) / 2, (c[1] + d[1]) / 2)
  await h.still()
  const json = JSON.parse(await text(page))
  assert.deepEqual(json.links, { 1: ['A', 'B'], 2: ['B', 'C', 'E'], 4: ['A', 'D'] })
  assert.deepEqual(Object.keys(json.lengths), ['AB', 'BC', 'AD'])
  assert.deepEqual(json.find, ['v_C', 'v_E', 'a_C', 'a_E', 'omega_2', 'alpha_2'])
  assert.equal(await page.locator('.sketch').count(), 1)
  assert.ok((await page.locator('.faults li').count()) > 0)
  // A point by which another has its place: it says so, and nothing changes.
  const before = await text(page)
  await h.joint('B')
  await h.still()
  assert.equal(await text(page), before)
  assert.match(await page.textContent('.note'), /points: E/)
  await undone(page, h, first)
  await page.waitForSelector('.screen svg [id$="mechanism-link-3"]', { state: 'attached' })
  assert.deepEqual(faults, [])
  await context.close()
})

test('a point and a link are renamed everywhere, and the answers are the same', { skip: quick }, async () => {
  for (const [name, point, link] of [['crank-rocker', 'B', '2'], ['shaper', 'A', '3'], ['wheel-in-groove', 'B', '4'], ['planetary-gear', 'P', '4']]) {
    const { page, context, faults, ...h } = await built(name)
    const first = Object.values(await h.answers())
    const old = await text(page)
    await h.joint(point)
    await h.type('name', 'X9')
    await page.evaluate((l) => {
      window.hodograph.builder.selected = { kind: 'link', name: l }
      window.hodograph.builder.properties()
    }, link)
    await h.type('name', '77')
    assert.notEqual(await text(page), old)
    assert.deepEqual(Object.values(await h.answers()), first, name)
    assert.ok(JSON.parse(await text(page)).links['77'], name)
    await undone(page, h, old)
    assert.deepEqual(faults, [])
    await context.close()
  }
})

/** What a tool makes: its clicks (a letter takes a tool), the driven place, and a part of the text. */
const TOOLS = {
  triangle: [['p', [0, 0], [250, 0], 'l', [0, 0], [50, 80], [50, 80], [220, 160], [140, 230], [220, 160], [250, 0]], [25, 40], /"2": \["C", "D", "E"\]/],
  slot: [['p', [0, 0], [0, -140], 'l', [0, 0], [60, 50], 'l', [0, -140], [80, 130], 't', [40, -5], [60, 50]], [30, 25], /"pin": "C", "slider": "3", "on": "2", "line": "BD"/],
  'block about a pivot': [['p', [0, 0], [150, 0], 'l', [0, 0], [40, 60], 't', [150, 0], [40, 60]], [20, 30], /"on": "2", "through": "B"/],
  wheel: [['p', [0, 0], 'l', [0, 0], [50, 60], [50, 60], [200, 50], 'w', [200, 50], [200, 0]], [25, 30], /"wheel": "3", "centre": "C", "radius": "50 mm"/],
  rack: [['p', [0, 0], 'r', [0, 0], [0, -50]], [35, 35], /"radii": \["50 mm"\], "rack": "2"/],
  cam: [['c', [0, 0], [0, 90]], [54, 0], /"cam": "1", "follower": "2", "roller": {"pin": "B"/],
  gears: [['p', [0, 0], [120, 0], 'g', [0, 0], [120, 0]], [0, 60], /"teeth": \[20, 20\]/],
  'driven slider': [['p', [0, 0], 'l', [0, 0], [60, 80], [60, 80], [280, 0], 's', [280, 0], [330, 0]], [280, 0], /"slide": "C", "position": "280 mm", "velocity": "1 m\/s"/],
}
for (const [name, [clicks, driven, wanted]] of Object.entries(TOOLS)) {
  test(`the tools make a mechanism that is solved: ${name}`, async () => {
    const { page, context, faults, ...h } = await empty()
    await h.still()
    for (const one of [...clicks, 'd', driven]) {
      if (typeof one === 'string') await page.keyboard.press(one)
      else await h.click(...one)
    }
    assert.ok(Object.values(await h.answers()).length > 1)
    assert.equal(await page.locator('.faults .error').count(), 0)
    assert.match(await text(page), wanted)
    await undone(page, h, EMPTY)
    assert.deepEqual(faults, [])
    await context.close()
  })
}

test('the drawing takes the place of the sketch, in its scale', async () => {
  const { page, context, ...h } = await empty()
  await h.click(0, 0)
  await h.click(200, 0)
  await page.keyboard.press('l')
  for (const at of [[0, 0], [60, 80], [60, 80], [220, 130], [220, 130], [200, 0]]) await h.click(...at)
  await h.still()
  // Its joints are dragged in the sketch too.
  await page.keyboard.press('v')
  const before = await text(page)
  await h.drag('D', 230, 140)
  assert.deepEqual(changed(before, await text(page)), ['/lengths/CD', '/lengths/BD', '/sketch/D/0', '/sketch/D/1'])
  await h.drag('B', 190, 0)
  assert.deepEqual(JSON.parse(await text(page)).points.B, ['190 mm', 0])
  const middle = async (locator) => {
    const box = await locator.boundingBox()
    return [box.x + box.width / 2, box.y + box.height / 2, box.width]
  }
  const sketched = await Promise.all([0, 1].map((k) => middle(page.locator('.sketch .pin').nth(k))))
  await page.keyboard.press('d')
  await h.click(30, 40)
  await h.still()
  const drawn = await Promise.all(['A', 'B'].map((p) => middle(page.locator(`.screen circle[id*="mechanism-pivot-${p}"]`))))
  sketched.forEach((spot, k) => spot.forEach((v, n) => assert.ok(Math.abs(v - drawn[k][n]) < 1, `${sketched} ${drawn}`)))
  await context.close()
})

test('tools and joints are reached by the keyboard, and Escape returns to the pointer', async () => {
  const { page, context, ...h } = await empty()
  await h.still()
  const keys = async (...all) => {
    for (const key of all) await page.keyboard.press(key)
    await h.still()
  }
  await page.locator('.board').focus()
  await keys('ArrowLeft', 'Enter', ...Array(4).fill('Shift+ArrowRight'), 'Enter', 'l', 'Enter', ...Array(2).fill('Shift+ArrowUp'), 'Enter')
  const { links, lengths } = JSON.parse(await text(page))
  assert.deepEqual(links, { 0: ['A', 'B'], 1: ['B', 'C'] })
  assert.deepEqual(lengths, { BC: '100 mm' })
  assert.equal(await page.getAttribute('.t-link', 'aria-pressed'), 'true')
  await keys('Escape', 'Escape')
  assert.equal(await page.getAttribute('.t-pointer', 'aria-pressed'), 'true')
  await keys('Control+z')
  assert.deepEqual(JSON.parse(await text(page)).links, { 0: ['A', 'B'] })
  await keys('Control+Shift+Z')
  await keys('Enter', 'Delete')
  assert.deepEqual(JSON.parse(await text(page)).links, { 0: ['A', 'B'] })
  await context.close()
})

test('the tools have their names in both languages, and none on a phone, where a scene that is not finished is still seen', async () => {
  const { page, context } = await empty()
  const labels = () => page.locator('.tool').evaluateAll((all) => all.map((b) => b.getAttribute('aria-label')))
  assert.ok((await labels()).includes('Ground pivot'))
  await page.click('.b-other')
  assert.ok((await labels()).includes('固定铰链'))
  assert.equal((await labels()).some((l) => /[a-z]/i.test(l)), false)
  const unfinished = '{"links": {"0": ["A", "B"], "1": ["A", "C"]}, "ground": "0", "points": {"A": [0, 0], "B": ["300 mm", 0]}, "sketch": {"C": ["50 mm", "80 mm"]}}'
  await begin(page, unfinished)
  await page.click('.b-share')
  await page.waitForFunction(() => location.hash.length > 100)
  const link = page.url()
  await page.setViewportSize({ width: 390, height: 844 })
  const phone = await context.newPage()
  await phone.setViewportSize({ width: 390, height: 844 })
  await phone.goto(link)
  await phone.waitForSelector('.sketch')
  assert.equal(await phone.locator('.palette').isVisible(), false)
  assert.equal(await phone.locator('.b-build').isVisible(), false)
  const box = await phone.locator('.board').boundingBox()
  await phone.mouse.move(box.x + 100, box.y + 100)
  await phone.mouse.down()
  await phone.mouse.move(box.x + 130, box.y + 140, { steps: 3 })
  await phone.mouse.up()
  assert.equal(await text(phone), unfinished)
  assert.ok((await phone.evaluate(() => document.documentElement.scrollWidth)) <= 390)
  await context.close()
})

test('the ground is renamed at a support, and a block becomes a bare pin and a block again', async () => {
  const { page, context, faults, ...h } = await built('slotted-lever')
  await h.still()
  const first = await text(page)
  const a = await page.locator('.screen [id$="mechanism-pivot-C"]').boundingBox()
  await page.mouse.click(a.x + a.width / 2, a.y + a.height - 1)
  await h.type('name', '7')
  assert.equal(JSON.parse(await text(page)).ground, '7')
  await h.undo()
  await h.joint('B')
  await h.find('v_B')
  await page.selectOption('.inspector select[aria-label="Runs"]', 'pin')
  await h.still()
  assert.deepEqual(JSON.parse(await text(page)).guides, [{ pin: 'B', on: '3', line: 'CD' }])
  await page.selectOption('.inspector select[aria-label="Runs"]', 'block')
  await h.still()
  assert.deepEqual(JSON.parse(await text(page)).guides, [{ pin: 'B', on: '3', line: 'CD', slider: '2' }])
  await undone(page, h, first)
  assert.deepEqual(faults, [])
  await context.close()
})

test('with Alt any joint moves the mechanism, and only its driver is written', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  await page.waitForFunction(() => window.hodograph.course?.can)
  await h.still()
  const [first, c] = [await text(page), await h.place('C')]
  await h.drag('C', c[0] - 25, c[1] + 2, { alt: true })
  await page.waitForFunction((was) => window.hodograph.editor.text !== was, first)
  await h.still()
  assert.deepEqual(changed(first, await text(page)), ['/parameters/phi_1'])
  const now = await h.place('C')
  assert.ok(Math.abs(now[0] - c[0] + 25) < 3, `${now}`)
  assert.deepEqual(faults, [])
  await context.close()
})

test('a driver is removed where it is shown, and the scene is a sketch again', async () => {
  const { page, context, faults, ...h } = await built('crank-rocker')
  await h.still()
  const first = await text(page)
  await page.click('.inspector h2 .remove')
  await h.still()
  assert.equal(JSON.parse(await text(page)).driver, undefined)
  assert.equal(await page.locator('.sketch').count(), 1)
  assert.deepEqual((await h.place('C')).map((v) => Math.round(v)), [274, 198])
  await undone(page, h, first)
  assert.deepEqual(faults, [])
  await context.close()
})
