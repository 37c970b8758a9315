//! Words and symbols of a plan.
use super::{Plan, Spot, VertexId};
use crate::scene::Scene;

/// Name of a vertex in capitals.
pub fn vertex_name(scene: &Scene, plan: &Plan, v: VertexId) -> String {
    let vertex = plan.vertex(v);
    let mut name = match vertex.spot {
        Spot::Point(p) => scene.point_name(p).to_string(),
        Spot::Special { .. } => "S".to_string(),
    };
    if let Some(n) = vertex.number {
        if name.ends_with(|c: char| c.is_ascii_digit()) {
            name.push(',');
        }
        name.push_str(scene.link_name(n));
    }
    name
}
