//! Every sampler of this crate keeps the laws of light samplers.

use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, PowerLightSampler, ReferenceBvhLightSampler,
    UniformLightSampler,
};

light_testkit::sampler_laws! {
    /// Every light alike.
    mod uniform {
        |set| UniformLightSampler::new(set.count())
    }

    /// In proportion to power.
    mod power {
        |set| PowerLightSampler::new(&set.powers()).expect("valid powers")
    }

    /// In proportion to importance.
    mod exhaustive {
        |set| ExhaustiveLightSampler::new(&set.extents()).expect("valid bounds")
    }

    /// The published hierarchy.
    mod reference_bvh {
        |set| ReferenceBvhLightSampler::new(&set.extents()).expect("valid bounds")
    }

    /// The default hierarchy.
    mod bvh {
        |set| BvhLightSampler::new(&set.extents()).expect("valid bounds")
    }
}
