// Elements in one call.

type Children = (Node | string | null | undefined | false)[]

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | boolean | ((event: Event) => void)> = {},
  ...children: Children
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name, value)
    else if (value === true) made.setAttribute(name, '')
    else if (value !== false) made.setAttribute(name, value)
  }
  made.append(...children.filter((c): c is Node | string => c !== null && c !== undefined && c !== false))
  return made
}

/** A picture from its text, as an element; scripts in it are not run. */
export function picture(svg: string): SVGSVGElement {
  const made = document.importNode(new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement, true) as unknown as SVGSVGElement
  made.querySelectorAll('[aria-label]').forEach(unlabelled)
  return made
}

/** A picture is read by its title and description; its parts have no names of their own there. */
function unlabelled(part: Element): void {
  part.removeAttribute('aria-label')
}

/** Elements of a picture from their text. */
export function parts(svg: string): Element[] {
  const within = document.createElementNS('http://www.w3.org/2000/svg', 'svg')
  within.innerHTML = svg
  within.querySelectorAll('[aria-label]').forEach(unlabelled)
  return [...within.children]
}

/** A fragment of the engine's markup. */
export function markup(html: string): DocumentFragment {
  const within = document.createElement('template')
  within.innerHTML = html
  return within.content
}
