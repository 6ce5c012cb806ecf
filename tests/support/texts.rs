//! Texts to change, and values to change them to.

use platewash_scenario::SHIPPED;
use platewash_scenario::keys::{Domain, KEYS, Key};
use proptest::prelude::*;
use serde_json::{Value, json};

/// Texts in which everything is that TOML allows: quoted and dotted keys, braces, other ends of lines, no end of the last.
pub const NASTY: &[(&str, &str)] = &[
    ("empty", ""),
    ("a mark alone", "\u{feff}"),
    ("a comment alone", "# nothing yet"),
    ("blank lines", "\n\n  \n"),
    (
        "dotted",
        "# top\nname = \"a\"\nwash.turns = 3 # three\nwash.\"points\" = 55\n# of the tool\ntool.length_m = 0.15\n\n[layout] # where\ncount = 2\n",
    ),
    (
        "braces",
        "tool = { length_m = 0.1, radius_m=0.02 }   # tool\nwash = {}\nlayout = {count = 2,\n  # where\n  positions_m = [[0.3, 0.0],\n    [0.1, 0.2]] # two\n}\nik = { # none\n}\nplant = {\n  substeps = 2, # few\n  integrator = 'rk4', # good\n}\ncontrol = { kp = 1.0, }\n",
    ),
    (
        "quoted",
        "\"name\" = 'its'\n[\"wash\"]\n'turns' = 3.0\n\"points\" = 1_00\n[ 'tool' ]\n\t\"length\\u005Fm\" = 1.5e-1\n",
    ),
    (
        "carriage returns and a mark",
        "\u{feff}# mark\r\nseed = 1 # one\r\n\r\n[job]\r\n# job\r\n\r\n# wash\r\n[wash]\r\n  turns = 3.0\r\n  points = 55 # many\r\n# end of wash\r\n\r\n[layout]\r\npositions_m = [\r\n  [0.3, 0.1], # sink\r\n  [-0.3, 0.1], # stove\r\n]",
    ),
    ("no end of the last line", "[wash]\nturns = 3 # last"),
    (
        "sections in another order",
        "[plant]\nsubsteps = 1\n[wash]\n\n# the layout\n# of today\n[layout]\ncount = 3\n\n\n# the job\n[job]",
    ),
    (
        "mistakes",
        "seed = -1\nunknown = { a = 1 }\n[wash]\nturns = nan\npoints = 1979-05-27\nheight_m = \"\"\"\ntall\"\"\"\n[wash.more]\nx = [[1, [2]], {}]\n[tool.more]\ny = 1\n[[others]]\nturns = 1\n[layout]\ncount = 3.0\npositions_m = [[0.3, 0.1, 0.2], [inf]]\n",
    ),
    (
        "lists",
        "[robot]\nstart_deg = [ 0,0 , 0, # three\n  0, 90, 0 ] # home\npackage_path = []\nhome_deg = [0x10, +1, 1.50, 0o7, 1_0, -0.0]\n[layout]\npositions_m = [\n  # by the sink\n  [0.3, 0.1],\n  [0.2, 0.3], # second\n  # by the stove\n  [ -0.1 , 0.4 ]  # last\n]\nx_m = [0.0, 0.3,]\n",
    ),
];

/// All texts.
pub fn texts() -> Vec<(&'static str, &'static str)> {
    let shipped = SHIPPED.iter().map(|s| (s.name, s.text));
    shipped.chain(NASTY.iter().copied()).collect()
}

/// One of the texts.
pub fn text() -> impl Strategy<Value = &'static str> {
    prop::sample::select(texts()).prop_map(|(_, text)| text)
}

/// A key, and a value that it takes.
pub fn change() -> impl Strategy<Value = (Key, Option<Value>)> {
    prop::sample::select(KEYS.as_slice()).prop_flat_map(|key| {
        let value = value_of(key.domain);
        (Just(key), prop::option::weighted(0.75, value))
    })
}

/// Any JSON, of numbers, words and nonsense.
pub fn nonsense() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        (-3..60i64).prop_map(Value::from),
        ".{0,12}".prop_map(Value::from),
        Just(json!("irb120")),
        Just(json!("x".repeat(5000))),
    ];
    leaf.prop_recursive(4, 64, 7, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..7).prop_map(Value::from),
            prop::collection::btree_map("[a-z]{0,3}", inner, 0..3).prop_map(|m| json!(m)),
        ]
    })
}

fn value_of(domain: Domain) -> BoxedStrategy<Value> {
    let several = |least, most, above, count: std::ops::RangeInclusive<usize>| {
        prop::collection::vec(number(least, most, above), count).prop_map(Value::from)
    };
    match domain {
        Domain::Text => "[^\\p{C}]{0,8}[a-z\"'\\\\#\\]}é]".prop_map(Value::from).boxed(),
        Domain::Path => "[ -~\t\n\r\u{7f}\u{1}é]{0,12}[a-z\"'\\\\#]"
            .prop_map(Value::from)
            .boxed(),
        Domain::Paths => prop::collection::vec("[a-z/\\\\'\"\n]{0,6}", 0..4)
            .prop_map(Value::from)
            .boxed(),
        Domain::Names => prop::collection::vec("[a-z_\"'\\\\é]{1,6}", 0..4)
            .prop_map(Value::from)
            .boxed(),
        Domain::Positions(least, most) => {
            let name = "[a-z_.\"'\\\\é]{1,6}";
            prop::collection::btree_map(name, number(least, most, false), 0..4)
                .prop_map(|all| Value::Object(all.into_iter().collect()))
                .boxed()
        }
        Domain::Word(words) => prop::sample::select(words).prop_map(Value::from).boxed(),
        Domain::Bool => any::<bool>().prop_map(Value::from).boxed(),
        Domain::Integer(least, most) => prop_oneof![least..=most, least..=most.min(least + 60)]
            .prop_map(Value::from)
            .boxed(),
        Domain::Number(least, most) => number(least, most, false).boxed(),
        Domain::NumberAbove(above, most) => number(above, most, true).boxed(),
        Domain::Range(least, most) => (number(least, most, false), number(least, most, false))
            .prop_filter("least below greatest", |(a, b)| a.as_f64() < b.as_f64())
            .prop_map(|(a, b)| json!([a, b]))
            .boxed(),
        Domain::Joints(least, most) => several(least, most, false, 6..=6).boxed(),
        Domain::JointsAbove(least, most) => several(least, most, true, 6..=6).boxed(),
        Domain::Points(least, most) => {
            let point = several(least, most, false, 2..=2);
            prop::collection::vec(point, 1..9).prop_map(Value::from).boxed()
        }
        Domain::Pair(least, most) => several(least, most, false, 2..=2).boxed(),
        Domain::Triple(least, most) => several(least, most, false, 3..=3).boxed(),
        Domain::TripleAbove(above, most) => several(above, most, true, 3..=3).boxed(),
        Domain::Scale(_, most) => several(0.0, most, true, 3..=3).boxed(),
        Domain::Plates => prop::collection::btree_set(0..1000_u32, 0..5)
            .prop_map(|plates| json!(plates))
            .boxed(),
        Domain::PairAbove(above, most) => several(above, most, true, 2..=2).boxed(),
        Domain::Knots(most_m, most_deg) => {
            let knots = prop::collection::btree_set(1..1_000_000u32, 1..9);
            let slopes = prop::collection::vec(number(-most_deg, most_deg, false), 9);
            (knots, slopes)
                .prop_map(move |(radii, slopes)| {
                    let radius = |part: u32| most_m * f64::from(part) / 1e6;
                    let knots = radii.into_iter().zip(slopes);
                    knots.map(|(part, slope)| json!([radius(part), slope])).collect()
                })
                .boxed()
        }
    }
}

/// A number of a range: any, its ends, whole ones with a point and without, tiny ones, a zero with a sign.
fn number(least: f64, most: f64, above: bool) -> impl Strategy<Value = Value> {
    let whole = (least.floor() as i64)..=(most.floor() as i64).min(1 << 20);
    let special = prop::sample::select(vec![
        least, most, -0.0, 0.0, 1e-300, 5e-324, 1e-7, 0.1, 0.145, 1.0, 20.0,
    ]);
    let any_number = prop_oneof![
        (least..=most).prop_map(Value::from),
        special.prop_map(Value::from),
        whole.clone().prop_map(Value::from),
        whole.prop_map(|v| Value::from(v as f64)),
    ];
    any_number.prop_filter("within the range", move |v| {
        v.as_f64()
            .is_some_and(|v| (least..=most).contains(&v) && !(above && v <= least))
    })
}
