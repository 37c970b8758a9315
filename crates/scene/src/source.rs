//! A scene with cams, read again at another position: each contact is then replaced by the pairs
//! that are right there.
//!
//! One equivalent linkage replaces a cam at one instant. Questions without a driver for the whole
//! motion are answered with the scene read again at each position.

use super::cams::raw::RawCam;
use super::json::Word;
use super::raw::{RawDriverKind, RawPlace, RawQuantity, RawScene};
use super::resolve;
use super::{Cam, Driver, Position, Scene};
use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use std::fmt;
use std::sync::Arc;

/// The source from which a scene with cams was read.
#[derive(Clone)]
pub struct Source(Arc<(RawScene, String)>);

impl Source {
    pub(super) fn of(raw: &RawScene, text: &str) -> Source {
        Source(Arc::new((raw.clone(), text.to_owned())))
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Source")
    }
}

/// Scenes compare by their contents.
impl PartialEq for Source {
    fn eq(&self, _: &Source) -> bool {
        true
    }
}

fn quantity(value: f64, unit: &str, span: Span) -> RawQuantity {
    RawQuantity { text: format!("({value:?}) {unit}"), span, bare: false }
}

impl Scene {
    /// Returns the scene as read at the present positions and rates of its drivers. `place` returns
    /// the places of points (m): exact for points with coordinates, rough for those that select the
    /// assembly.
    ///
    /// # Errors
    /// Those of reading; `no-source` for a scene without cams or loads, for one that was not read
    /// from a file, and for one with a cam driven through wheels at an unknown angle.
    pub fn read_again(&self, place: &dyn Fn(&str) -> Option<[f64; 2]>) -> Result<Scene, Faults> {
        // The file gives the angle of a cam driven through wheels at the instant.
        let angle = |cam: &RawCam| {
            let own = |c: &&Cam| {
                self.link_name(c.cam) == cam.cam.text
                    && self.link_name(c.follower) == cam.follower.text
            };
            let turning = self.cams.iter().find(own)?.disc.as_ref()?;
            let driver = self.drivers[turning.driver].kind.position()?;
            Some(turning.from + turning.way * driver.value())
        };
        let nowhere = |cam: &RawCam| cam.angle.is_some() && angle(cam).is_none();
        if self.source.as_ref().is_some_and(|Source(source)| source.0.cams.iter().any(nowhere)) {
            let message = both!("how a cam behind wheels stands is told for one pose");
            return Err(Diagnostic::error("no-source", message).into());
        }
        let fixed = |name: &str| {
            self.links[self.ground.0].points.iter().any(|p| self.point_name(*p) == name)
        };
        self.reread(|raw| {
            for (own, driver) in raw.drivers.iter_mut().zip(&self.drivers) {
                let [rate, acceleration] =
                    if driver.kind.turns() { ["rad/s", "rad/s^2"] } else { ["m/s", "m/s^2"] };
                own.rate = Some(quantity(driver.rate.value, rate, driver.span));
                own.acceleration = driver
                    .acceleration
                    .as_ref()
                    .map(|a| quantity(a.value, acceleration, driver.span));
                write_position(&mut own.kind, driver);
            }
            for cam in &mut raw.cams {
                cam.angle = cam
                    .angle
                    .as_ref()
                    .and_then(|told| Some(quantity(angle(cam)?, "rad", told.span)));
            }
            let at =
                |name: &str, span: Span| place(name).map(|at| at.map(|x| quantity(x, "m", span)));
            for (name, own) in raw.points.iter_mut().filter(|(name, _)| !fixed(&name.text)) {
                if let (RawPlace::At(_), Some(xy)) = (&*own, at(&name.text, name.span)) {
                    *own = RawPlace::At(xy);
                }
            }
            for (name, own) in &mut raw.sketch {
                if let Some(xy) = at(&name.text, name.span) {
                    *own = xy;
                }
            }
        })
    }

    /// Returns the scene as read with other values of some parameters, each an expression.
    ///
    /// # Errors
    /// As [`Scene::read_again`].
    pub fn read_with(&self, values: &[(&str, String)]) -> Result<Scene, Faults> {
        self.reread(|raw| {
            for (name, own) in &mut raw.parameters {
                if let Some((_, text)) = values.iter().find(|(of, _)| *of == name.text) {
                    *own = RawQuantity { text: text.clone(), span: own.span, bare: false };
                }
            }
        })
    }

    fn reread(&self, change: impl FnOnce(&mut RawScene)) -> Result<Scene, Faults> {
        let none = || Diagnostic::error("no-source", both!("the scene was not read from a file"));
        let Source(source) = self.source.as_ref().ok_or_else(none)?;
        let (raw, text) = source.as_ref();
        let mut raw = raw.clone();
        raw.find =
            Some(self.find.iter().map(|f| Word { text: f.text.clone(), span: f.span }).collect());
        change(&mut raw);
        let mut faults = Faults::default();
        let scene = resolve::resolve(&raw, text, &mut faults);
        faults.list.retain(|d| d.severity == hodograph_base::diag::Severity::Error);
        scene.filter(|_| !faults.has_errors()).ok_or(faults)
    }
}

/// Gives a driver with a stated position its present position.
fn write_position(own: &mut RawDriverKind, driver: &Driver) {
    let Some(position) = driver.kind.position() else { return };
    let (RawDriverKind::Turn { angle: slot, .. }
    | RawDriverKind::Slide { position: slot, .. }
    | RawDriverKind::Cylinder { length: slot, .. }) = own;
    if slot.is_some() {
        let unit = if matches!(position, Position::Angle(_)) { "rad" } else { "m" };
        *slot = Some(quantity(position.value(), unit, driver.span));
    }
}
