//! All keys of the format, by object: the decoder, its messages and the test of the schema use
//! these lists.

pub(super) const SCENE: &[&str] = &[
    "title",
    "statement",
    "parameters",
    "time",
    "units",
    "answers",
    "links",
    "ground",
    "points",
    "lengths",
    "guides",
    "cams",
    "gears",
    "rolling",
    "belts",
    "chains",
    "ropes",
    "driver",
    "motions",
    "gravity",
    "masses",
    "forces",
    "springs",
    "friction",
    "balance",
    "sketch",
    "side",
    "find",
    "composite",
    "attempts",
    "readings",
    "paper",
    "language",
    "notation",
];
pub(super) const PLACE_XY: &[&str] = &["base", "x", "y"];
pub(super) const PLACE_POLAR: &[&str] = &["base", "length", "angle"];
pub(super) const GUIDE: &[&str] =
    &["pin", "slider", "on", "line", "through", "angle", "offset", "centre", "radius", "length"];
pub(super) const GEAR: &[&str] = &[
    "links",
    "centres",
    "radii",
    "teeth",
    "module",
    "ring",
    "rack",
    "line",
    "through",
    "angle",
    "at",
    "phase",
    "pressure_angle",
    "shift",
    "addendum",
    "clearance",
];
pub(super) const ROLLING: &[&str] = &[
    "wheel",
    "centre",
    "radius",
    "on",
    "line",
    "through",
    "angle",
    "track",
    "track_radius",
    "inside",
    "at",
    "phase",
];
pub(super) const BELT: &[&str] =
    &["pulleys", "centres", "radii", "crossed", "reversed", "at", "phase"];
pub(super) const CHAIN: &[&str] =
    &["sprockets", "centres", "teeth", "pitch", "reversed", "at", "phase"];
pub(super) const ROPE: &[&str] = &["drum", "centre", "radius", "load", "line", "angle", "at"];
pub(super) const TURN: &[&str] =
    &["link", "against", "line", "against_line", "angle", "omega", "alpha"];
pub(super) const SLIDE: &[&str] = &["slide", "position", "velocity", "acceleration"];
pub(super) const CYLINDER: &[&str] = &["cylinder", "length", "rate", "acceleration", "links"];
pub(super) const MOTION: &[&str] = &["point", "on", "line", "centre", "radius", "angle", "s"];
pub(super) const COMPOSITE: &[&str] = &["point", "on", "frame"];
pub(super) const ATTEMPT: &[&str] = &["mistake", "pair", "link", "printed", "why"];
pub(super) const PAPER: &[&str] = &["size", "mu_l", "mu_v", "mu_a", "mu_F", "pencil"];
pub(super) const CAM: &[&str] =
    &["cam", "follower", "edge", "roller", "arc", "face", "profile", "at", "angle"];
pub(super) const ROLLER: &[&str] = &["pin", "radius", "link"];
pub(super) const ARC: &[&str] = &["pin", "radius"];
pub(super) const FACE: &[&str] = &["through", "line", "angle", "offset", "cam"];
pub(super) const CAM_PART: &[&str] = &["centre", "radius", "corner"];
pub(super) const CAM_LAW: &[&str] = &["base", "start", "turns", "law"];
pub(super) const CAM_STAGE: &[&str] = &["rise", "dwell", "return", "over", "law"];
pub(super) const MASS: &[&str] = &["m", "weight", "J", "k", "at"];
pub(super) const FORCE: &[&str] =
    &["on", "at", "F", "M", "angle", "line", "against", "over", "diagram"];
pub(super) const OVER: &[&str] = &["slide", "toward", "stroke", "turn", "angles"];
pub(super) const DIAGRAM: &[&str] = &["slide", "toward", "turn", "period", "points"];
pub(super) const SPRING: &[&str] = &["from", "to", "k", "free"];
pub(super) const FRICTION: &[&str] = &["pin", "slider", "on", "circle", "radius", "f"];
pub(super) const BALANCE: &[&str] = &["link", "at", "angle"];
