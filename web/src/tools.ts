// The tools of building: names, letters, steps, and their signs.

import type { Word } from './words'

export type ToolName = 'pointer' | 'pivot' | 'link' | 'node' | 'slider' | 'slot' | 'wheel' | 'gear' | 'rack' | 'cam' | 'driver' | 'delete'

export interface Tool {
  name: ToolName
  /** The letter of the keyboard. */
  letter: string
  /** Instructions for each click. */
  steps: Word[]
  /** The sign, in a square of 24. */
  sign: string
}

const pin = (x: number, y: number) => `<circle cx="${x}" cy="${y}" r="1.9" class="fill"/>`
const hatch = (x: number, y: number, n: number) => Array.from({ length: n }, (_, k) => `M${x + 3 * k} ${y}l-2 2.6`).join('')

export const TOOLS: Tool[] = [
  { name: 'pointer', letter: 'V', steps: ['step_pointer'], sign: '<path d="M6 3.5l12 9.6-5.4.7 3 5.9-2.3 1.2-3-6L6 18.6z" class="fill"/>' },
  { name: 'pivot', letter: 'P', steps: ['step_pivot'], sign: `<path d="M12 6l4.6 10H7.4zM4.5 16h15${hatch(7, 16, 5)}"/>${pin(12, 6)}` },
  { name: 'link', letter: 'L', steps: ['step_from', 'step_to'], sign: `<path d="M5 18L19 6" stroke-width="2.2"/>${pin(5, 18)}${pin(19, 6)}` },
  { name: 'node', letter: 'N', steps: ['step_node'], sign: `<path d="M4 17L20 17M12 7.5L4 17M12 7.5L20 17"/>${pin(4, 17)}${pin(20, 17)}<circle cx="12" cy="7.5" r="2.2" class="dark"/>` },
  { name: 'slider', letter: 'S', steps: ['step_pin', 'step_direction'], sign: `<path d="M3 17h18${hatch(6, 17, 6)}"/><path d="M7 9h10v8H7z" class="fill"/>${pin(12, 13)}` },
  { name: 'slot', letter: 'T', steps: ['step_carrier', 'step_pin'], sign: `<path d="M3 20L21 4" stroke-width="2.2"/><path d="M6.6 12.3l6.6-5.9 4.2 4.7-6.6 5.9z" class="fill"/>${pin(12, 11.7)}` },
  { name: 'wheel', letter: 'W', steps: ['step_centre', 'step_touch'], sign: `<circle cx="12" cy="10.5" r="7"/><path d="M3 17.5h18${hatch(6, 17.5, 6)}"/>${pin(12, 10.5)}` },
  { name: 'gear', letter: 'G', steps: ['step_gear', 'step_other'], sign: `<circle cx="7.4" cy="14.5" r="4.6" stroke-dasharray="2 1.2"/><circle cx="16.4" cy="9.6" r="5.6" stroke-dasharray="2 1.2"/>${pin(7.4, 14.5)}${pin(16.4, 9.6)}` },
  { name: 'rack', letter: 'R', steps: ['step_gear', 'step_line'], sign: `<circle cx="12" cy="8.5" r="5.6" stroke-dasharray="2 1.2"/><path d="M2.5 19v-2.5l2-2h2l2 2h2l2-2h2l2 2h2l2-2h1V19z"/>${pin(12, 8.5)}` },
  { name: 'cam', letter: 'C', steps: ['step_cam', 'step_follower'], sign: `<path d="M12 11c4.5 0 6 2.4 6 5s-2.6 5-6 5-6-2-6-5 1.500-5 6-5zM12 8.6V2.500"/><circle cx="12" cy="8.800" r="2.200" class="fill"/>${pin(12, 16.5)}` },
  { name: 'driver', letter: 'D', steps: ['step_driver'], sign: `<path d="M7 19L15 9"/>${pin(7, 19)}<path d="M4.500 10.500A9.500 9.500 0 0 1 19.500 15" stroke-width="1.800"/><path d="M21.600 12.200l-1.800 4.400-3.600-3z" class="dark"/>` },
  { name: 'delete', letter: 'X', steps: ['step_delete'], sign: '<path d="M5 7h14M9.500 7V4.500h5V7M7 7l.8 13h8.400L17 7M10.300 10.500v6M13.700 10.500v6"/>' },
]
