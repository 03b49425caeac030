//! The laws that every sampler obeys, on sets of every kind.

use light_samplers::UniformLightSampler;

light_testkit::sampler_laws! {
    mod uniform { |set| UniformLightSampler::new(set.count()) }
}
