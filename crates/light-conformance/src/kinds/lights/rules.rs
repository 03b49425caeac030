//! Why the reference differs where ours is the answer in double precision.

use crate::Rule;

pub(super) const LOOSE_BOX: Rule = Rule {
    name: "loose_box",
    reason: "the reference bounds the turned box of a sphere or a disk, ours is the smallest box",
};

pub(super) const PATCH_AREA: Rule = Rule {
    name: "patch_area",
    reason: "the reference adds nine flat pieces of a patch, ours is the integral",
};

pub(super) const WIDE_NORMALS: Rule = Rule {
    name: "wide_normals",
    reason: "a cone wider than a half space is not convex, so the normals between the corners may \
             leave it: ours is the whole sphere",
};

pub(super) const PICTURE_POWER: Rule = Rule {
    name: "picture_power",
    reason: "the reference adds the centres of a picture's texels, ours is the integral: both are \
             computed",
};

pub(super) const PORTAL_POWER: Rule = Rule {
    name: "portal_power",
    reason: "the reference divides by the solid angle per area where it has to multiply, and \
             leaves out the cosine",
};

pub(super) const DARK: Rule = Rule {
    name: "dark_sample",
    reason: "the reference returns a sample that carries no light, ours is none",
};

pub(super) const NO_SAMPLE: Rule = Rule {
    name: "no_sample",
    reason: "the surface is seen from its edge, or another part of it is in the way: there is no \
             sample, or ours is it",
};

pub(super) const MISSED: Rule = Rule {
    name: "assumes_a_hit",
    reason: "the reference answers the density of the whole shape for directions that miss it",
};

pub(super) const OWN_SAMPLE: Rule = Rule {
    name: "misses_its_own_sample",
    reason: "the reference's intersection misses the point that it has sampled, on the edge of a \
             shape or a window",
};

pub(super) const OWN_DIRECTION: Rule = Rule {
    name: "density_of_the_direction",
    reason: "the reference gives the density at the point before its direction is rounded; ours is \
             that where the rounded direction meets the patch",
};

pub(super) const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the reference loses digits, or chooses by area where its solid angle has lost them",
};

pub(super) const SMALL_RECTANGLE: Rule = Rule {
    name: "small_rectangle",
    reason: "below 1e-3 sr the reference samples the area of a rectangle, which is not what its \
             density says",
};

pub(super) const ANNULUS: Rule = Rule {
    name: "annulus",
    reason: "the reference samples the disk without its hole, and most points fall into it; ours \
             moves its circles",
};

pub(super) const NO_SIDES: Rule = Rule {
    name: "reversed_and_two_sided",
    reason: "the reference turns over a surface that shines on both sides, which moves what u \
             stands for",
};

pub(super) const HORIZON: Rule = Rule {
    name: "horizon",
    reason: "the cosine of a ray that leaves along the surface is the root of a rounded difference",
};

pub(super) const AXIS: Rule = Rule {
    name: "axis",
    reason: "near a cone's axis the reference rounds the cosine to 1, or its search for the place \
             ends early",
};

pub(super) const TEXEL_EDGE: Rule = Rule {
    name: "texel_edge",
    reason: "the direction lies on the edge of a texel up to rounding, or of the reference's \
             inverse map",
};

pub(super) const WINDOW: Rule = Rule {
    name: "outside_of_the_window",
    reason: "the reference does not look whether a direction passes the portal; no light comes \
             from there",
};

pub(super) const PORTAL_RAYS: Rule = Rule {
    name: "portal_rays",
    reason: "rays from the reference's portal start all around the scene, most of them beside the \
             portal; ours start on it",
};

pub(super) const WRAP: Rule = Rule {
    name: "octahedral_wrap",
    reason: "beyond the lower edges and the corners of an equal-area map the reference takes the \
             second texel, not the first: its rectified picture, and the sum of that, differ from \
             ours",
};
