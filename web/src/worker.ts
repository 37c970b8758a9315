// The engine's thread: answers messages one after the other; a trap ends it.

interface Exports {
  memory: WebAssembly.Memory
  input(length: number): number
  call(): number
  font(): number
  output(): number
  fault(): number
  fault_length(): number
}

let engine: Exports | undefined

function put(bytes: Uint8Array): void {
  const of = engine!
  const address = of.input(bytes.length)
  new Uint8Array(of.memory.buffer, address, bytes.length).set(bytes)
}

/** The message of the panic that ended the engine. */
function told(): string {
  const length = engine?.fault_length() ?? 0
  return length ? new TextDecoder().decode(new Uint8Array(engine!.memory.buffer, engine!.fault(), length)) : ''
}

function answer(message: Uint8Array): Uint8Array<ArrayBuffer> {
  const of = engine!
  put(message)
  const length = of.call()
  return new Uint8Array(of.memory.buffer as ArrayBuffer, of.output(), length)
}

// One after the other: the engine is there before the first message is answered.
let before: Promise<void> = Promise.resolve()
self.onmessage = (event: MessageEvent) => {
  before = before.then(() => handled(event.data))
}

/** A message is a text for the engine, or bytes for the writer of PDF. */
interface Message { id: number; module?: WebAssembly.Module; font?: ArrayBuffer; message?: string; bytes?: Uint8Array }

async function handled({ id, module, font, message, bytes }: Message): Promise<void> {
  try {
    if (module) engine = (await WebAssembly.instantiate(module, {})).exports as unknown as Exports
    if (font) {
      put(new Uint8Array(font))
      engine!.font()
    }
    if (bytes) return self.postMessage({ id, bytes: answer(bytes).slice() })
    self.postMessage({ id, answer: message ? new TextDecoder().decode(answer(new TextEncoder().encode(message))) : '{"ok":true}' })
  } catch (fault) {
    self.postMessage({ id, trap: `${fault} ${told()}` })
  }
}
