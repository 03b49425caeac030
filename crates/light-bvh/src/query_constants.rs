//! What a port of the queries to another language has to know.

use crate::cut::grow::{MAX_REVISION, MAX_STEP_REVISION, MAX_STEP_RISE};
use crate::cut::light_cut;
use crate::importance::child_importance::{
    BESIDE, BOX_EMISSION, DOUBT, GROUP_BY_POSITION, NEARNESS, RAMP_BY_POSITION, STEP_EDGE, UNIT,
};
use crate::importance::child_view::{DISTANCE, ROUND_OFF};
use crate::importance::glossy::{self, MIN_ALPHA, MIN_COS, MIN_DIFFUSE, MIN_HALF_SQ, WIDENING};
use crate::importance::horizon::HEIGHT;
use crate::importance::position::FAR;
use crate::importance::segment::{BENT, NEAREST, PLACES};
use crate::importance::sheet;
use crate::node::sheet_code::CORRELATION;
use crate::node::spread_code::LEAST_SPREAD;
use crate::node::wide_node::{FAINT_POWER, SMALL_EXTENT};
use crate::query::look_ahead::{NEAR_SHARE, NEAR_SMALL};
use crate::query::uncertain::{MORE_ODDS, ODDS};
use crate::query::weights::{LEAST_SHARE, LEAST_TOTAL, MAX_ZOOM, MOST};

/// The numbers in the importance of a group of lights, by name, for ports of the queries to another
/// language. They change with the estimate: a port takes them from here.
pub const QUERY_CONSTANTS: [(&str, f32); 39] = [
    ("BENT", BENT),
    ("BESIDE", BESIDE),
    ("BOX_EMISSION", BOX_EMISSION),
    ("CUT_THRESHOLD", light_cut::THRESHOLD),
    ("DISTANCE", DISTANCE),
    ("DOUBT", DOUBT),
    ("FAINT_POWER", FAINT_POWER as f32),
    ("FAR", FAR),
    ("GLOSSY_DISTANCE", glossy::DISTANCE),
    ("GROUP_BY_POSITION", GROUP_BY_POSITION),
    ("HEIGHT", HEIGHT),
    ("LEAST_SHARE", LEAST_SHARE),
    ("LEAST_SPREAD", LEAST_SPREAD),
    ("LEAST_TOTAL", LEAST_TOTAL),
    ("MAX_REVISION", MAX_REVISION),
    ("MAX_STEP_REVISION", MAX_STEP_REVISION),
    ("MAX_STEP_RISE", MAX_STEP_RISE),
    ("MAX_ZOOM", MAX_ZOOM),
    ("MIN_ALPHA", MIN_ALPHA),
    ("MIN_COS", MIN_COS),
    ("MIN_DIFFUSE", MIN_DIFFUSE),
    ("MIN_HALF_SQ", MIN_HALF_SQ),
    ("MORE_ODDS", MORE_ODDS),
    ("MOST", MOST),
    ("NEAREST", NEAREST),
    ("NEARNESS", NEARNESS),
    ("NEAR_SHARE", NEAR_SHARE),
    ("NEAR_SMALL", NEAR_SMALL),
    ("ODDS", ODDS),
    ("PLACES", PLACES as f32),
    ("RAMP_BY_POSITION", RAMP_BY_POSITION),
    ("ROUND_OFF", ROUND_OFF),
    ("SHEET_CORRELATION", CORRELATION),
    ("SHEET_NEARER", sheet::NEARER),
    ("SHEET_THICKNESS", sheet::LEAST_THICKNESS),
    ("SMALL_EXTENT", SMALL_EXTENT as f32),
    ("STEP_EDGE", STEP_EDGE),
    ("UNIT", UNIT),
    ("WIDENING", WIDENING),
];
