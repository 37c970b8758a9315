//! The reactions of random mechanisms in 640 bits, by Newton's equations of every link and pin,
//! written independently: accelerations are differences of positions, and no group, row or polygon
//! is used.

use super::forces::Load;
use hodograph::answer::MotionSource;
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::Level;
use hodograph::number::{Big, Real};
use hodograph::position::Path;
use hodograph::scene::{DriverKind, GuideId, LinkId, PointId, Scene};
use hodograph::worked::Worked;

/// Equations of equilibrium: a column for each unknown.
struct Equations<'a> {
    scene: &'a Scene,
    /// The first of three rows of each link: forces to the right and up, moments about the origin.
    of_link: Vec<Option<usize>>,
    /// The first of two rows of each pin.
    of_pin: Vec<Option<usize>>,
    rows: Vec<Vec<Big>>,
    right: Vec<Big>,
}

impl Equations<'_> {
    fn column(&mut self) -> usize {
        let column = self.rows[0].len();
        self.rows.iter_mut().for_each(|row| row.push(Big::from_f64(0.0)));
        column
    }

    /// Adds a force of unknown size on a link at a place.
    fn push(&mut self, column: usize, link: LinkId, at: Point<Big>, along: Vec2<Big>) {
        let Some(row) = self.of_link[link.0] else { return };
        for (k, part) in [along.x, along.y, at.to_vec2().cross(along)].into_iter().enumerate() {
            self.rows[row + k][column] = self.rows[row + k][column] + part;
        }
    }

    fn turn(&mut self, column: usize, link: LinkId, moment: f64) {
        let Some(row) = self.of_link[link.0] else { return };
        self.rows[row + 2][column] = self.rows[row + 2][column] + Big::from_f64(moment);
    }

    fn on_pin(&mut self, column: usize, pin: PointId, along: Vec2<Big>) {
        let Some(row) = self.of_pin[pin.0] else { return };
        for (k, part) in [along.x, along.y].into_iter().enumerate() {
            self.rows[row + k][column] = self.rows[row + k][column] + part;
        }
    }

    /// Adds a known force, and a moment about the origin, on a link.
    fn load(&mut self, link: LinkId, force: Vec2<Big>, moment: Big) {
        let Some(row) = self.of_link[link.0] else { return };
        for (k, part) in [force.x, force.y, moment].into_iter().enumerate() {
            self.right[row + k] = self.right[row + k] - part;
        }
    }

    /// Solves for the unknowns by elimination with row pivots; `None` if their number differs from
    /// that of the equations, or they are not determined.
    fn solved(mut self) -> Option<Vec<Big>> {
        let n = self.rows.len();
        if self.rows[0].len() != n {
            return None;
        }
        for k in 0..n {
            let size = |r: &usize| self.rows[*r][k].approx().abs();
            let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            if size(&pivot) < 1e-9 {
                return None;
            }
            self.rows.swap(k, pivot);
            self.right.swap(k, pivot);
            for r in k + 1..n {
                let part = self.rows[r][k] / self.rows[k][k];
                for c in k..n {
                    self.rows[r][c] = self.rows[r][c] - part * self.rows[k][c];
                }
                self.right[r] = self.right[r] - part * self.right[k];
            }
        }
        let mut found = vec![Big::from_f64(0.0); n];
        for k in (0..n).rev() {
            let rest = (k + 1..n).fold(self.right[k], |sum, c| sum - self.rows[k][c] * found[c]);
            found[k] = rest / self.rows[k][k];
        }
        Some(found)
    }
}

/// The force of each pin on each of its moving links; `None` for scenes with cylinders, wheels or
/// links of unknown pose, and where reactions are not determined.
pub fn reactions(
    scene: &Scene,
    worked: &Worked,
    loads: &[Load],
) -> Option<Vec<(PointId, LinkId, Vec2<Big>)>> {
    let motion = hodograph::effort::truth::differences(scene, worked).ok()?;
    let at = &motion.now;
    let drivers_turn_or_slide = scene.drivers.iter().all(|d| d.kind.ends().is_none());
    if !scene.rolling.is_empty() || !drivers_turn_or_slide || !scene.loads.springs.is_empty() {
        return None;
    }
    let (zero, one) = (Big::from_f64(0.0), Big::from_f64(1.0));
    let mut count = 0;
    let mut of_link = vec![None; scene.links.len()];
    for l in (0..scene.links.len()).map(LinkId).filter(|l| *l != scene.ground) {
        at.poses[l.0]?;
        of_link[l.0] = Some(count);
        count += 3;
    }
    let on_ground = |p: PointId| scene.links[scene.ground.0].points.contains(&p);
    let slots =
        |p: PointId| scene.guides.iter().filter(|g| g.pin == Some(p) && g.slider.is_none()).count();
    let mut of_pin = vec![None; scene.points.len()];
    let pins: Vec<PointId> = (0..scene.points.len())
        .map(PointId)
        .filter(|p| scene.carriers(*p).count() + slots(*p) > 1)
        .collect();
    for p in pins.iter().filter(|p| !on_ground(**p)) {
        of_pin[p.0] = Some(count);
        count += 2;
    }
    let mut all = Equations {
        scene,
        of_link,
        of_pin,
        rows: vec![Vec::new(); count],
        right: vec![zero; count],
    };
    if count == 0 {
        return None;
    }
    let mut of_pins = Vec::new();
    for p in &pins {
        let place = at.points[p.0]?;
        for link in scene.carriers(*p).filter(|l| *l != scene.ground) {
            let columns = [Vec2::new(one, zero), Vec2::new(zero, one)].map(|u| {
                let column = all.column();
                all.push(column, link, place, u);
                all.on_pin(column, *p, -u);
                column
            });
            of_pins.push((*p, link, columns));
        }
    }
    for g in 0..scene.guides.len() {
        guide(&mut all, GuideId(g), at)?;
    }
    for driver in &scene.drivers {
        let column = all.column();
        match &driver.kind {
            DriverKind::Turn { link, against, .. } => {
                all.turn(column, *link, 1.0);
                all.turn(column, *against, -1.0);
            }
            DriverKind::Slide { guide, .. } => {
                let (place, along) = tangent(scene, *guide, at)?;
                let own = &scene.guides[guide.0];
                match (own.slider, own.pin) {
                    (Some(slider), _) => all.push(column, slider, place, along),
                    (None, Some(pin)) => all.on_pin(column, pin, along),
                    (None, None) => return None,
                }
                all.push(column, own.on, place, -along);
            }
            DriverKind::Cylinder { .. } => return None,
        }
    }
    let big = Big::from_f64;
    for l in loads {
        let place = at.points[l.at.0]?.to_vec2();
        let mut force = Vec2::new(big(l.force[0]), big(l.force[1]));
        let mut couple = big(l.couple);
        if l.mass != 0.0 {
            force = force - motion.vector(Level::Acceleration, l.at, None)? * big(l.mass);
            couple = couple - motion.turning(Level::Acceleration, l.link)? * big(l.inertia);
        }
        all.load(l.link, force, place.cross(force) + couple);
    }
    let found = all.solved()?;
    Some(
        of_pins
            .into_iter()
            .map(|(p, link, [x, y])| (p, link, Vec2::new(found[x], found[y])))
            .collect(),
    )
}

/// The place of the part that runs in a guide, and the unit vector along the guide there.
fn tangent(
    scene: &Scene,
    g: GuideId,
    at: &hodograph::position::Configuration<Big>,
) -> Option<(Point<Big>, Vec2<Big>)> {
    let guide = &scene.guides[g.0];
    let p = guide.pin.or_else(|| scene.links[guide.slider?.0].points.first().copied());
    let place = match p {
        Some(p) => at.points[p.0]?,
        None => at.poses[guide.slider?.0]?.origin,
    };
    Some(match at.guides[g.0]? {
        Path::Line { direction, .. } => (place, direction),
        Path::Arc { centre, .. } => (place, (place - centre).unit()?.perp()),
    })
}

/// Adds the unknowns of a guide: for a slot a force perpendicular to it, for a straight guide with
/// a slider also a couple, for a curved one a force through its centre.
fn guide(
    all: &mut Equations,
    g: GuideId,
    at: &hodograph::position::Configuration<Big>,
) -> Option<()> {
    let scene = all.scene;
    let own = &scene.guides[g.0];
    let (place, along) = tangent(scene, g, at)?;
    match (own.slider, at.guides[g.0]?) {
        (None, _) => {
            let column = all.column();
            all.on_pin(column, own.pin?, along.perp());
            all.push(column, own.on, place, -along.perp());
        }
        (Some(slider), Path::Line { .. }) => {
            let column = all.column();
            all.push(column, slider, place, along.perp());
            all.push(column, own.on, place, -along.perp());
            let column = all.column();
            all.turn(column, slider, 1.0);
            all.turn(column, own.on, -1.0);
        }
        (Some(slider), Path::Arc { centre, .. }) => {
            for u in [along, along.perp()] {
                let column = all.column();
                all.push(column, slider, centre, u);
                all.push(column, own.on, centre, -u);
            }
        }
    }
    Some(())
}
