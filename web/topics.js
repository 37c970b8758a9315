// The templates by topic, in the order of the gallery. A test checks that each template has one.
export const TOPICS = [
  ['Vector equations', '矢量方程', 'closing-side two-magnitudes two-directions magnitude-and-direction'],
  ['Four-bar linkages', '四杆机构', 'crank-rocker pump-jack drag-link crossed-four-bar parallelogram third-crank wiper radar-dish flying-shear level-luffing-crane treadle camera-claw mixer'],
  ['Sliders, slots and cylinders', '滑块、导杆与液压缸', 'slider-crank offset-slider-crank oblique-guide slotted-lever whitworth oscillating-cylinder scotch-yoke elliptic-trammel oldham-coupling curved-slot two-slots'],
  ['Six-bars and more', '六杆及多杆机构', 'shaper toggle-press watt-six-bar stephenson-six-bar class-iii-six-bar class-iv-six-bar double-butterfly pantograph atkinson radial-engine jansen-leg'],
  ['Several drivers', '多个原动件', 'five-bar robot-arm excavator'],
  ['Gears, wheels, belts', '齿轮、滚轮与带', 'planetary-gear three-planets hypocycloid sun-and-planet geared-five-bar gear-linkage belt-crank-rocker hoist rack-stroke-doubler wheel-in-groove'],
  ['Cams', '凸轮机构', 'cam-eccentric cam-valve-train cam-offset-roller cam-on-arm eccentric-three-ways flat-face-mistake flat-face-mistake-2'],
  ['Instantaneous centres', '速度瞬心', 'shaper-centres five-bar-centres cam-centres'],
  ['Composite motion', '点的合成运动', 'turning-plate plate-by-law cart-by-law disc-on-rod lathe ships plate-in-space ring-in-space pursuit pursuit-of-a-ship'],
  ['Forces', '力分析', 'four-bar-forces press-forces shaper-forces engine-forces compressor-friction toggle-clamp loader-forces'],
  ['Synthesis', '机构综合', 'function body time-ratio limits path cognates straight-line'],
].map(([en, zh, names]) => ({ en, zh, names: names.split(' ') }))
