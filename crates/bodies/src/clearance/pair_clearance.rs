//! Distance of a pair of bodies at one configuration, and the clearance required of it.

use serde::Serialize;

/// Distance between two bodies at one configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairClearance {
    /// Name of the first body.
    pub a: String,
    /// Name of the second body.
    pub b: String,
    /// Distance \[m\]; ≤ 0 if they touch or overlap.
    pub distance_m: f64,
    /// Midpoint between the two nearest points \[m\], base frame.
    pub place_m: [f64; 3],
    /// True if the shape of one of the bodies is a convex hull of a mesh or of a part of it, which can reach beyond the mesh.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub has_hull: bool,
    /// Link and axis on which the tool is mounted, where one of the bodies is of it and its mount is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mounted_on: Option<String>,
    /// Part of the required clearance that the pair need not keep \[m\].
    #[serde(skip_serializing_if = "platewash_workcell::json::is_zero")]
    pub reduced_by_m: f64,
}

impl PairClearance {
    /// Clearance required of the pair where `required_m` is required of most pairs \[m\].
    #[must_use]
    pub fn required_m(&self, required_m: f64) -> f64 {
        required_of(required_m, self.reduced_by_m)
    }

    /// True if the pair keeps the clearance that is required of it where `required_m` is required of most pairs.
    #[must_use]
    pub fn is_clear(&self, required_m: f64) -> bool {
        is_clear(self.distance_m, self.required_m(required_m))
    }

    /// Words for a message on the pair: that a convex hull was compared, and where the tool is mounted; empty where neither is so.
    #[must_use]
    pub fn notes(&self) -> String {
        let hull = self.has_hull.then(|| "by convex shapes of meshes".to_owned());
        let mount = self
            .mounted_on
            .as_ref()
            .map(|mount| format!("the tool is mounted on {mount}"));
        let notes: Vec<_> = hull.into_iter().chain(mount).collect();
        match notes.is_empty() {
            true => String::new(),
            false => format!(" ({})", notes.join("; ")),
        }
    }
}

/// Clearance required of a pair that need not keep all of it \[m\].
pub(crate) fn required_of(required_m: f64, reduced_by_m: f64) -> f64 {
    if reduced_by_m == 0.0 {
        required_m
    } else {
        (required_m - reduced_by_m).max(0.0)
    }
}

/// True if a distance \[m\] keeps the required clearance \[m\]. If that is 0, only contact breaks it. False for NaN.
#[must_use]
pub fn is_clear(distance_m: f64, required_m: f64) -> bool {
    distance_m > 0.0 && distance_m >= required_m
}
