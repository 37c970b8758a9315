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
