//! Load on the sponge while it washes: strain, contact force, and friction torque about its axis.
//!
//! Formulas (30.1) to (31.2) in `docs/contact.md`, as compressions and volumes of foam.
//!
//! The foam presses with E w / H over a column of the cross-section dA, along the sponge's axis: with the volume V = ∫ max(w, 0) dA the
//! force along the axis is E V / H, whatever way the surface faces, as long as there is no friction. Friction μ acts on what the plate
//! presses along its normal, which is 1/cos γ as much, at a lever of at most r: its torque about the axis is no more than
//! μ E/H ∫ max(w, 0) r / cos γ dA. What the plate's holder takes across the plate's axis and about it is bounded alike (`holding.rs`).
//!
//! The strain, the greatest force and the torque are those from approach to retreat: coming and leaving, the tip may be deeper than in the
//! wash. The least force is that of the wash, as the sponge meets the plate and leaves it with none.
//!
//! On a disc all of this follows from the height of the tip and the tilt alone (`contact/level.rs`), on other faces from columns at the
//! moments of the wash and what they may do between them (`contact/plate_load.rs`).
//!
//! On a face that is no disc the bounds come from branch and bound over the wash, the worst stretch first.
//!
//! The wash is cut into stretches of many moments each. What the plate asks of the foam over a stretch follows from where the columns
//! stand at both ends of it and from how the sponge may move between them (`contact/plate_load.rs`): loosely over a long stretch or with few
//! columns. Of each quantity the stretch with the worst bound is looked at more closely, with more columns or in halves, until that is as
//! near to what is shown of a single moment, with the most columns, as [`NEAR`] asks. It asks the same whatever the requirements are.

use crate::washing::instants::Instants;
use crate::washing::turning_frame::TurningFrame;
use platewash_bodies::contact::{
    Bends, Columns, Foundation, HolderVolumes, Level, Moment, PlateLoad, Press, SpongeState,
};
use platewash_workcell::plate::Plate;

/// Friction coefficient μ between a wet sponge and a plate, least and greatest: an assumption.
pub(crate) const FRICTION: [f64; 2] = [0.3, 1.0];

/// Proved bounds of a wash on a disc.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiscWashBounds {
    /// Upper bound on the height of the tip over or under the face \[m\].
    pub height_m: f64,
    /// Lower bound on cos τ, with τ the tilt of the tool.
    pub cosine: f64,
    /// Upper bound on the distance of the tip from the plate's axis \[m\].
    pub distance_m: f64,
    /// Height error of the plate, ±δ \[m\].
    pub error_m: f64,
}

/// Extreme value of a quantity over a wash, with the bound proved for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extreme {
    /// Proved bound: the quantity never gets beyond it.
    pub bound: f64,
    /// Value that is certainly attained.
    pub seen: f64,
    /// Time of `seen` \[s\].
    pub time_s: f64,
    /// Position of `seen`, plate frame \[m\].
    pub place_m: [f64; 3],
}

/// Load on the sponge during a wash, as compression and volumes of foam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pressing {
    /// Greatest compression, H times the strain of formula (30.1) \[m\].
    pub deepest: Extreme,
    /// Volume V of compressed foam, formula (31.1) \[m³\]: the least, with the plate at its lowest, and the greatest, with the plate at its
    /// highest.
    pub volume: [Extreme; 2],
    /// Upper bound on ∫ max(w, 0) r / cos γ dA, the friction torque of formula (31.2) divided by μ E/H \[m⁴\].
    pub twist_m4: f64,
    /// Upper bounds of what the plate's holder takes.
    pub holder: HolderVolumes,
}

impl Pressing {
    /// Returns the start value of a fold: no moment and no stretch seen yet.
    pub fn new() -> Self {
        let extreme = |worst| Extreme {
            bound: worst,
            seen: worst,
            time_s: 0.0,
            place_m: [0.0; 3],
        };
        let (least, most) = (extreme(f64::INFINITY), extreme(f64::NEG_INFINITY));
        Self {
            deepest: most,
            volume: [least, most],
            twist_m4: 0.0,
            holder: HolderVolumes::default(),
        }
    }

    /// Returns the result where nothing is proved: every bound is as bad as possible.
    pub fn unknown() -> Self {
        let mut all = Self::new();
        all.take(&Press::UNKNOWN);
        all
    }

    /// Bounds the load during a wash on a disc, formulas (30.1) to (31.2). `known` has the worst |z| without δ, cos τ, distance d and δ.
    pub fn on_disc(plate: &Plate, foundation: &Foundation, instants: &Instants, known: &DiscWashBounds) -> Self {
        let mut all = Self::new();
        let rim_m = plate.rim_m();
        let press = |height_m: [f64; 2], cosine: f64, distance_m: f64| {
            let level = Level {
                height_m,
                cosine,
                distance_m,
            };
            foundation.level_press(&level, rim_m)
        };
        for moment in &instants.moments {
            let (tip, cosine) = (&moment.pose.tip, -moment.pose.axis.z);
            let distance_m = tip.xy().norm();
            let [low, high] = [1.0, -1.0].map(|up| press([tip.z + up * known.error_m; 2], cosine, distance_m));
            let wholly_on = distance_m + foundation.radius_m / cosine <= rim_m;
            let seen = PlateLoad {
                volume_m3: [low.volume_m3[1], high.volume_m3[0]],
                deepest_m: high.deepest_m[usize::from(wholly_on)],
                deepest_at_m: [tip.x, tip.y, 0.0],
            };
            all.see(&seen, moment.t_s, (*tip).into());
        }
        let (height_m, bounded) = (known.height_m + known.error_m, known.cosine > 0.0);
        if bounded && height_m.is_finite() && known.distance_m.is_finite() {
            let level = press([-height_m, height_m], known.cosine, known.distance_m);
            all.take(&level.into());
        } else {
            all.take(&Press::UNKNOWN);
        }
        all
    }

    /// Bounds the load before or after the wash on a disc, formulas (30.1) to (31.2). `error_m` is δ. Each stretch is bounded from the two
    /// moments at its ends. With h the length of the stretch, the tip is no lower than the lower end by more than h²/8 · sup ‖p̈‖, and the axis no
    /// farther from the nearer end than h/2 times its greatest speed.
    pub fn around_disc(plate: &Plate, foundation: &Foundation, instants: &Instants, error_m: f64) -> Self {
        let mut all = Self::new();
        let press = |tip_m: f64, cosine: f64, distance_m: f64| {
            let level = Level {
                height_m: [tip_m - error_m; 2],
                cosine,
                distance_m,
            };
            foundation.level_press(&level, plate.rim_m())
        };
        for moment in &instants.moments {
            let (tip, cosine) = (&moment.pose.tip, -moment.pose.axis.z);
            let distance_m = tip.xy().norm();
            let attained = press(tip.z, cosine, distance_m);
            let wholly_on = distance_m + foundation.radius_m / cosine <= plate.rim_m();
            if cosine > 0.0 {
                let seen = PlateLoad {
                    volume_m3: [f64::INFINITY, attained.volume_m3[0]],
                    deepest_m: attained.deepest_m[usize::from(wholly_on)],
                    deepest_at_m: [tip.x, tip.y, 0.0],
                };
                all.see(&seen, moment.t_s, (*tip).into());
            }
        }
        for (ends, drift) in instants.moments.windows(2).zip(&instants.drifts) {
            let sag_m = 0.125 * drift.length_s * drift.length_s * drift.tip_m_s2;
            let lower = |of: fn(&Moment) -> f64| of(&ends[0]).min(of(&ends[1]));
            let low_m = lower(|moment| moment.pose.tip.z) - sag_m;
            let cosine = lower(|moment| -moment.pose.axis.z) - 0.5 * drift.length_s * drift.axis;
            if !(low_m.is_finite() && cosine > 0.0) {
                return Self::unknown();
            }
            let distance_m = -lower(|moment| -moment.pose.tip.xy().norm()) + sag_m;
            all.take(&press(low_m, cosine, distance_m).into());
        }
        all
    }

    /// Raises the upper bounds to cover the load `around`, before or after the wash.
    pub fn cover_load(&mut self, around: &Self) {
        let greater = |most: &mut Extreme, other: &Extreme| {
            let bound = most.bound.max(other.bound);
            if other.seen > most.seen {
                *most = *other;
            }
            most.bound = bound;
        };
        greater(&mut self.deepest, &around.deepest);
        greater(&mut self.volume[1], &around.volume[1]);
        self.twist_m4 = self.twist_m4.max(around.twist_m4);
        self.holder = self.holder.or_greater(&around.holder);
    }

    /// Updates the attained values with those of one moment.
    pub fn see(&mut self, load: &PlateLoad, time_s: f64, place_m: [f64; 3]) {
        let [least, most] = &mut self.volume;
        if load.volume_m3[0] < least.seen {
            (least.seen, least.time_s, least.place_m) = (load.volume_m3[0], time_s, place_m);
        }
        if load.volume_m3[1] > most.seen {
            (most.seen, most.time_s, most.place_m) = (load.volume_m3[1], time_s, place_m);
        }
        if load.deepest_m > self.deepest.seen {
            (self.deepest.seen, self.deepest.time_s) = (load.deepest_m, time_s);
            self.deepest.place_m = load.deepest_at_m;
        }
    }

    /// Updates the bounds with those over a stretch. NaN bounds nothing; it counts as the worst value.
    pub fn take(&mut self, press: &Press) {
        let greater = |most: f64, found: f64| if found.is_nan() { f64::INFINITY } else { most.max(found) };
        self.deepest.bound = greater(self.deepest.bound, press.deepest_m);
        self.twist_m4 = greater(self.twist_m4, press.twist_m4);
        self.holder = self.holder.or_greater(&press.holder);
        let [least, most] = &mut self.volume;
        let [low, high] = press.volume_m3;
        least.bound = if low.is_nan() { 0.0 } else { least.bound.min(low) };
        most.bound = greater(most.bound, high);
    }
}

/// Number of moments in a stretch at the start of the search.
const LONGEST: usize = 64;

/// Relative gap allowed between the bounds and the values at single moments, per quantity: least and greatest volume, compression, twist; of
/// the holder, pressed along normals, across the axis, and about it.
const NEAR: [f64; QUANTITIES] = [0.01, 0.01, 0.01, 0.02, 0.02, 0.02, 0.02];

/// Loss of compression between moments above which a stretch is halved instead of given more columns \[m\].
const MOST_SAG_M: f64 = 1e-4;

/// Number of column grids: a coarse one and a fine one.
const GRIDS: usize = 2;

/// Number of bounded quantities, and of those on the sponge, which come first. Each is expressed so that greater is worse, see
/// [`severities`].
const QUANTITIES: usize = 7;
const ON_SPONGE: usize = 4;

/// Stretch between two moments, given by their indices, with the bounds over it.
struct Span {
    from: usize,
    to: usize,
    /// Index of the column grid: 0 is coarse, 1 is fine.
    grid: usize,
    press: Press,
}

/// Branch-and-bound search through the wash of one plate.
struct Search<'a> {
    bends: Bends<'a>,
    instants: &'a Instants,
    turning: TurningFrame<'a>,
    error_m: f64,
    grids: [Columns; GRIDS],
    /// State of the columns by column grid and moment; `None` until it is computed.
    standings: [Vec<Option<SpongeState>>; GRIDS],
    spans: Vec<Span>,
    /// Worst value at a single moment, per quantity.
    at_moments: [f64; QUANTITIES],
    /// Bounds no worse than these are not refined.
    enough: [f64; QUANTITIES],
    found: Pressing,
}

/// Bounds the load during a wash on any face, in columns (30, 31 on a profile). `error_m` is δ.
pub(crate) fn on_face(plate: &Plate, foundation: &Foundation, instants: &Instants, error_m: f64) -> Pressing {
    search(plate, error_m, foundation, instants, [f64::NEG_INFINITY; QUANTITIES])
}

/// Bounds the load before or after a wash on any face, in columns. `error_m` is δ. Refines until the load is shown to be no higher than in
/// `wash`, otherwise as far as [`on_face`] does.
pub(crate) fn around_face(
    plate: &Plate,
    foundation: &Foundation,
    instants: &Instants,
    wash: &Pressing,
    error_m: f64,
) -> Pressing {
    let (holder, most_m3) = (&wash.holder, wash.volume[1].bound);
    let enough = [
        f64::INFINITY,
        most_m3,
        wash.deepest.bound,
        wash.twist_m4,
        holder.normal_m3,
        holder.slope_m3,
        holder.turn_m4,
    ];
    search(plate, error_m, foundation, instants, enough)
}

fn search(
    plate: &Plate,
    error_m: f64,
    foundation: &Foundation,
    instants: &Instants,
    enough: [f64; QUANTITIES],
) -> Pressing {
    let count = instants.moments.len();
    if count == 0 {
        return Pressing::unknown();
    }
    let mut search = Search {
        bends: Bends::new(&plate.surface),
        instants,
        turning: TurningFrame::new(plate, instants),
        error_m,
        grids: [Columns::new(foundation), Columns::fine(foundation)],
        standings: [vec![None; count], vec![None; count]],
        spans: Vec::new(),
        at_moments: [f64::NEG_INFINITY; QUANTITIES],
        enough,
        found: Pressing::new(),
    };
    let last = count - 1;
    for from in (0..last.max(1)).step_by(LONGEST) {
        let to = (from + LONGEST).min(last);
        let span = search.bound_stretch(from, to, 0);
        search.spans.push(span);
    }
    for quantity in 0..ON_SPONGE {
        search.refine_worst(quantity);
    }
    let mut found = search.found;
    for span in &search.spans {
        found.take(&span.press);
    }
    // What is looked at for the holder changes no bound on the sponge.
    for quantity in ON_SPONGE..QUANTITIES {
        search.refine_worst(quantity);
    }
    let all = search.spans.iter().map(|span| span.press.holder);
    found.holder = all.fold(HolderVolumes::default(), |most, next| most.or_greater(&next));
    found
}

/// Returns the quantities of a press, each expressed so that greater is worse. NaN counts as infinite.
fn severities(press: &Press) -> [f64; QUANTITIES] {
    let (holder, [least_m3, most_m3]) = (&press.holder, press.volume_m3);
    let all = [
        -least_m3,
        most_m3,
        press.deepest_m,
        press.twist_m4,
        holder.normal_m3,
        holder.slope_m3,
        holder.turn_m4,
    ];
    all.map(|bad| if bad.is_nan() { f64::INFINITY } else { bad })
}

impl Search<'_> {
    /// Refines the worst stretches of a quantity until its bound is near enough to the values at single moments.
    fn refine_worst(&mut self, quantity: usize) {
        loop {
            let bad = |span: &Span| severities(&span.press)[quantity];
            let worst = (0..self.spans.len()).max_by(|a, b| bad(&self.spans[*a]).total_cmp(&bad(&self.spans[*b])));
            let Some(worst) = worst else { return };
            let at_moments = self.at_moments[quantity];
            let near = (at_moments + NEAR[quantity] * at_moments.abs()).max(self.enough[quantity]);
            if bad(&self.spans[worst]) <= near || !self.refine(worst) {
                return;
            }
        }
    }

    /// Refines a stretch, by halving or with more columns. Returns `false` where neither is possible.
    fn refine(&mut self, span: usize) -> bool {
        let Span {
            from, to, grid, press, ..
        } = self.spans[span];
        let finest = grid + 1 == GRIDS;
        let longer = to - from > 1;
        if longer && (finest || press.sag_m > MOST_SAG_M) {
            let middle = from + (to - from) / 2;
            self.spans[span] = self.bound_stretch(from, middle, grid);
            let second = self.bound_stretch(middle, to, grid);
            self.spans.push(second);
        } else if !finest {
            self.spans[span] = self.bound_stretch(from, to, grid + 1);
        }
        longer || !finest
    }

    /// Bounds a stretch with the given column grid.
    fn bound_stretch(&mut self, from: usize, to: usize, grid: usize) -> Span {
        self.compute_state(from, grid);
        self.compute_state(to, grid);
        let standings = &self.standings[grid];
        let press = match (&standings[from], &standings[to]) {
            (Some(a), Some(b)) => {
                let drift = self.turning.drift(from, to);
                self.grids[grid].bound_load(&self.bends, [a, b], &drift)
            }
            _ => Press::UNKNOWN,
        };
        Span { from, to, grid, press }
    }

    /// Computes the state of the columns at a moment. With the fine grid it also updates the attained values.
    fn compute_state(&mut self, at: usize, grid: usize) {
        if self.standings[grid][at].is_some() {
            return;
        }
        let (columns, moment) = (&self.grids[grid], &self.instants.moments[at]);
        let standing = columns.sponge_state(&self.bends, &moment.pose, &self.turning.side(at), self.error_m);
        if grid + 1 == GRIDS {
            let (seen, press) = columns.load_at(&self.bends, &standing);
            self.found.see(&seen, moment.t_s, moment.pose.tip.into());
            for (most, found) in self.at_moments.iter_mut().zip(severities(&press)) {
                *most = most.max(found);
            }
        }
        self.standings[grid][at] = Some(standing);
    }
}
