//! Texts that are no SRDF.

use platewash_kinematics::{DisabledPairs, SrdfError};

#[test]
fn rejects_text_that_is_no_srdf() {
    assert!(matches!(DisabledPairs::parse(""), Err(SrdfError::NotARobot { .. })));
    assert!(matches!(
        DisabledPairs::parse("<sdf/>"),
        Err(SrdfError::NotARobot { .. })
    ));
    assert!(matches!(DisabledPairs::parse("<robot>"), Err(SrdfError::Xml { .. })));
    assert!(matches!(
        DisabledPairs::parse("<robot></sdf>"),
        Err(SrdfError::Xml { .. })
    ));
    let half = r#"<robot><disable_collisions link1="a"/></robot>"#;
    assert!(matches!(
        DisabledPairs::parse(half),
        Err(SrdfError::MissingAttribute { attribute: "link2", .. })
    ));
}
