// A link that holds the scene, and files for the user.

const KEY = '#s='

async function through(bytes: Uint8Array<ArrayBuffer>, stream: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream as ReadableWritablePair)).arrayBuffer())
}

/** The fragment of a link: the text deflated, in base64 for addresses. */
export async function fragment(text: string): Promise<string> {
  const packed = await through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'))
  let raw = ''
  for (const byte of packed) raw += String.fromCharCode(byte)
  return KEY + btoa(raw).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')
}

/** The text that a fragment holds; null if it holds none. */
export async function shared(hash: string): Promise<string | null> {
  if (!hash.startsWith(KEY)) return null
  const raw = atob(hash.slice(KEY.length).replaceAll('-', '+').replaceAll('_', '/'))
  const bytes = Uint8Array.from(raw, (c) => c.charCodeAt(0))
  return new TextDecoder('utf-8', { fatal: true }).decode(await through(bytes, new DecompressionStream('deflate-raw')))
}

/** Offers a file for saving. */
export function save(name: string, content: string | Blob | Uint8Array<ArrayBuffer>): void {
  const type = name.endsWith('.svg') ? 'image/svg+xml' : name.endsWith('.html') ? 'text/html' : 'text/plain'
  const bytes = content instanceof Uint8Array ? new Blob([content], { type: name.endsWith('.pdf') ? 'application/pdf' : 'application/octet-stream' }) : content
  const blob = typeof bytes === 'string' ? new Blob([bytes], { type: `${type};charset=utf-8` }) : bytes
  const url = URL.createObjectURL(blob)
  const link = document.createElement('a')
  link.href = url
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(url), 10_000)
}

/** A figure as PNG, at dots per inch; the letters are outlines, so that no font is needed. */
export async function pixels(svg: string, dpi: number): Promise<Blob> {
  const picture = new Image()
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`
  await picture.decode()
  const side = (name: string) => Number(new RegExp(` ${name}="([\\d.]+)mm"`).exec(svg)![1])
  const canvas = document.createElement('canvas')
  canvas.width = Math.round((side('width') / 25.4) * dpi)
  canvas.height = Math.round((side('height') / 25.4) * dpi)
  const context = canvas.getContext('2d')!
  context.fillStyle = '#fff'
  context.fillRect(0, 0, canvas.width, canvas.height)
  context.drawImage(picture, 0, 0, canvas.width, canvas.height)
  return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('PNG'))), 'image/png'))
}
