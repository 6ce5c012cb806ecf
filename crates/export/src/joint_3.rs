//! Count of axis 3 by a controller.

use platewash_kinematics::JointVector;

/// Count of axis 3 by a controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Joint3 {
    /// On its own: the description's joint 3.
    #[default]
    Independent,
    /// Together with axis 2: the sum of the description's joints 2 and 3.
    WithJoint2,
}

impl Joint3 {
    /// Both, in the order in which messages name them.
    pub const ALL: [Self; 2] = [Self::WithJoint2, Self::Independent];

    /// The word for it in settings and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Independent => "independent",
            Self::WithJoint2 => "with-joint-2",
        }
    }

    /// The count of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|count| count.name() == name)
    }

    /// Turns positions or speeds of the description's joints into those of the maker's, in any unit of angle.
    #[must_use]
    pub fn convert(self, description: &JointVector) -> JointVector {
        self.shifted(description, 1.0)
    }

    /// Turns positions or speeds of the maker's joints into those of the description's, in any unit of angle.
    #[must_use]
    pub fn convert_back(self, maker: &JointVector) -> JointVector {
        self.shifted(maker, -1.0)
    }

    fn shifted(self, joints: &JointVector, sign: f64) -> JointVector {
        let mut joints = *joints;
        if self == Self::WithJoint2 {
            joints[2] += sign * joints[1];
        }
        joints
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn converted_joints_come_back_and_lines_stay_lines(
            a in proptest::array::uniform6(-6.0..6.0_f64),
            b in proptest::array::uniform6(-6.0..6.0_f64),
            part in 0.0..1.0_f64,
        ) {
            let [a, b] = [a, b].map(JointVector::from);
            for count in Joint3::ALL {
                prop_assert!((count.convert_back(&count.convert(&a)) - a).amax() < 1e-14);
                let between = count.convert(&a).lerp(&count.convert(&b), part);
                prop_assert!((between - count.convert(&a.lerp(&b, part))).amax() < 1e-14);
                prop_assert_eq!(Joint3::named(count.name()), Some(count));
            }
            prop_assert_eq!(Joint3::WithJoint2.convert(&a)[2], a[2] + a[1]);
        }
    }
}
