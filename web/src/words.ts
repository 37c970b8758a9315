// The words of the page in both languages.

export type Lang = 'en' | 'zh'

const WORDS = {
  gallery: ['Gallery', '模板库'],
  undo: ['Undo', '撤销'],
  redo: ['Redo', '重做'],
  share: ['Copy link', '复制链接'],
  shared: ['The link is copied; it holds the scene', '链接已复制，其中含机构文件'],
  save: ['Save as', '另存为'],
  classroom: ['Classroom', '课堂'],
  leave: ['Leave', '退出'],
  theme: ['Light or dark', '明暗'],
  other: ['中文', 'English'],
  text: ['Text', '文本'],
  answers: ['Answers', '结果'],
  play: ['Play', '播放'],
  pause: ['Pause', '暂停'],
  position: ['Position of the driver', '原动件位置'],
  back: ['Back to the scene’s own position', '回到题给位置'],
  previous: ['Previous step', '上一步'],
  next: ['Next step', '下一步'],
  step: ['Step', '步'],
  search: ['Search templates', '搜索模板'],
  close: ['Close', '关闭'],
  nothing: ['No template has these words', '没有匹配的模板'],
  working: ['Computing …', '计算中……'],
  cancel: ['Stop', '停止'],
  cancelled: ['Stopped', '已停止'],
  trapped: ['The engine failed and was started again; the text is as it was', '计算引擎出错，已重新启动；文本未变'],
  stale: ['The drawing is of the last valid text', '图为上次有效文本的结果'],
  agree: ['Drawing and loop equations agree to', '图解与解析相对差不超过'],
  disagree: ['Drawing and loop equations disagree: this is a fault of hodograph', '图解与解析不一致：这是本程序的错误'],
  unanswered: ['Some questions have no answer in this pose', '此位置有些所求量不存在'],
  dropped: ['Drop a scene file', '拖放机构文件到此'],
  drag: ['Drag the mechanism to move it', '拖动机构可使其运动'],
  none: ['The scene asks for no such figure', '所求各量没有此图'],
  live: ['Drawing', '作图'],
  steps: ['Steps', '步骤'],
  sheet: ['Sheet', '整图'],
  mechanism: ['Mechanism', '机构'],
  velocity: ['Velocity', '速度'],
  acceleration: ['Acceleration', '加速度'],
  forces: ['Forces', '力'],
  lever: ['Lever', '杠杆'],
  groups: ['Groups', '杆组'],
  cam: ['Cam', '凸轮'],
  curves: ['Curves', '运动线图'],
  plates: ['Plates', '分页'],
  equations: ['Equations', '方程'],
  results: ['Results', '结果表'],
  centres: ['Centres', '瞬心'],
  kutzbach: ['Kutzbach', '轮系图'],
  gears: ['Teeth', '齿廓'],
  composite: ['Composite motion', '合成运动'],
  attempts: ['Wrong attempts', '典型错误'],
  curvature: ['Curvature', '曲率'],
  centrodes: ['Centrodes', '瞬心线'],
  inversions: ['Inversions', '倒置'],
  cognates: ['Cognates', '同源机构'],
  as_svg: ['This figure (SVG)', '当前图（SVG）'],
  as_png: ['This figure (PNG)', '当前图（PNG）'],
  as_problem: ['Worksheet, problem (HTML)', '习题（HTML）'],
  as_solution: ['Worksheet, solution (HTML)', '解答（HTML）'],
  as_md: ['Worksheet (Markdown)', '习题与解答（Markdown）'],
  as_typ: ['Worksheet (Typst)', '习题与解答（Typst）'],
  as_lesson: ['Lesson (HTML)', '演示课（HTML）'],
  as_csv: ['Table of the whole motion (CSV)', '整个运动的数表（CSV）'],
  as_text: ['Answers and steps (text)', '结果与步骤（文本）'],
  as_json: ['Answers (JSON)', '结果（JSON）'],
  as_scene: ['Scene (JSON)', '机构文件（JSON）'],
  rejected: ['This file is too large for a scene', '文件过大，不是机构文件'],
  unreadable: ['The link holds no scene', '链接中没有机构文件'],
  candidate: ['Candidate', '方案'],
  create: ['New', '新建'],
  build: ['Build', '搭建'],
  board: ['Drawing board: arrow keys move, Enter clicks', '画板：方向键移动，回车键点击'],
  fit: ['Show all', '全部显示'],
  tool_pointer: ['Select and drag', '选择与拖动'],
  tool_pivot: ['Ground pivot', '固定铰链'],
  tool_link: ['Link', '杆件'],
  tool_node: ['Point on a link', '杆上的点'],
  tool_slider: ['Slider on the ground', '机架上的滑块'],
  tool_slot: ['Slider on a link', '杆上的滑块'],
  tool_wheel: ['Wheel that rolls', '滚轮'],
  tool_gear: ['Gears in mesh', '齿轮啮合'],
  tool_rack: ['Rack', '齿条'],
  tool_cam: ['Cam by a law of motion', '按运动规律的凸轮'],
  tool_driver: ['Driver', '原动件'],
  tool_delete: ['Delete', '删除'],
  step_pointer: ['click a joint or a link for its properties; drag a joint to change its lengths, with Alt to move the mechanism', '点击铰链或构件可看其参数；拖动铰链改变其尺寸，按住 Alt 则使机构运动'],
  step_pivot: ['click its place in the plane', '点击其位置'],
  step_from: ['click the first joint or an empty place', '点击第一个铰链或空白处'],
  step_to: ['click the second joint or an empty place', '点击第二个铰链或空白处'],
  step_more: ['the link is made. A third point makes it a triangle; a click on one of its ends begins the next link; Escape ends', '杆件已画好。再点一点成三角形；点其一端开始下一杆；Esc 结束'],
  step_node: ['click the place on a link', '点击杆上的位置'],
  step_pin: ['click the joint of the block or an empty place', '点击滑块的铰链或空白处'],
  step_direction: ['click in the direction of its guide', '点击导路的方向'],
  step_carrier: ['click the link that carries the slot, or its pivot', '点击带导槽的杆，或其铰链'],
  step_centre: ['click the centre of the wheel', '点击轮心'],
  step_touch: ['click where it touches its track', '点击轮与轨道的接触处'],
  step_gear: ['click the link that carries the gear, or the centre of a new one', '点击装有齿轮的杆，或新齿轮的轴心'],
  step_other: ['click the other gear: its link or its centre', '点击另一齿轮：其杆或轴心'],
  step_line: ['click where the rack touches the gear', '点击齿条与齿轮的接触处'],
  step_cam: ['click the pivot of the cam', '点击凸轮轴心'],
  step_follower: ['click where its roller is', '点击滚子的位置'],
  step_driver: ['click the link or slider that is driven', '点击原动件'],
  step_delete: ['click a joint or a link', '点击铰链或构件'],
  properties: ['Properties', '参数'],
  name: ['Name', '名称'],
  ground: ['Ground', '机架'],
  a_link: ['Link', '构件'],
  a_pivot: ['Pivot', '固定铰链'],
  a_joint: ['Joint', '铰链'],
  delete: ['Delete', '删除'],
  drive: ['Make it the driver', '设为原动件'],
  ask: ['Find', '求'],
  all_asked: ['Nothing is chosen: everything is found', '未选：求全部'],
  coordinates: ['Coordinates', '坐标'],
  lengths: ['Lengths', '长度'],
  length: ['Length', '长度'],
  angle: ['Angle', '角度'],
  offset: ['Offset', '偏距'],
  driver: ['Driver', '原动件'],
  rate: ['Rate', '速度'],
  guide: ['Guide', '导路'],
  runs: ['Runs', '形式'],
  block: ['as a block', '滑块'],
  bare: ['as a bare pin', '销在槽中'],
  gear: ['Gears', '齿轮'],
  phase: ['Phase', '相位'],
  ring: ['Mesh', '啮合'],
  outside: ['external', '外啮合'],
  ring_of: ['internal, ring:', '内啮合，内齿轮'],
  wheel: ['Wheel', '轮'],
  radius: ['Radius', '半径'],
  base: ['Base circle', '基圆'],
  roller: ['Roller', '滚子'],
  rise: ['Rise', '推程'],
  return: ['Return', '回程'],
  dwell: ['Dwell', '停歇'],
  over: ['Over', '转角'],
  law: ['Law', '规律'],
  no_link: ['There is no link here', '此处没有构件'],
  no_quantity: ['This is no quantity, such as 120 mm', '这不是量值，例如 120 mm'],
  taken: ['A name has letters and digits, and belongs to nothing else', '名称由字母和数字组成，且不得重复'],
  unrenamed: ['The scene could not be read with this name', '用此名称无法读取机构文件'],
  ground_remains: ['The ground remains', '机架不能删除'],
  still: ['It is still mentioned in:', '仍被引用：'],
  unmovable: ['Its place follows from other quantities of the text', '其位置由其他量决定'],
} satisfies Record<string, [string, string]>

export type Word = keyof typeof WORDS

export function word(key: Word, lang: Lang): string {
  return WORDS[key][lang === 'zh' ? 1 : 0]
}

export function isWord(key: string): key is Word {
  return key in WORDS
}

const GREEK: Record<string, string> = {
  omega: 'ω', alpha: 'α', phi: 'φ', mu: 'μ', rho: 'ρ', psi: 'ψ', theta: 'θ', beta: 'β', gamma: 'γ', delta: 'δ',
}

/** A quantity as `find` writes it, set as a formula. */
export function formula(find: string): DocumentFragment {
  const out = document.createDocumentFragment()
  const cut = find.indexOf('_')
  const [letter, rest] = cut < 0 ? [find, ''] : [find.slice(0, cut), find.slice(cut + 1)]
  const parts = /^([av])(n|t|k|c|r)$/.exec(letter)
  const set = (tag: string, text: string) => {
    const element = document.createElement(tag)
    element.textContent = text
    out.append(element)
  }
  set('i', GREEK[letter] ?? (parts ? parts[1]! : letter))
  if (parts) set('sup', parts[2]!)
  if (rest) set('sub', rest)
  return out
}
