use super::World;
use crate::content_digest::content_digest;

impl World {
    /// Digests of what rays meet, each with the name of what it is of: every vertex, material and
    /// texel counts. Lights without a surface and media are not in them.
    pub(crate) fn digests(&self) -> [(&'static str, String); 3] {
        // Ids of lights follow the order of the instances in the scene. The rest by content,
        // because the order in the hierarchy is a matter of how that is built.
        let instances = (0u32..).zip(self.accel.instances());
        let mut instances: Vec<_> = instances
            .map(|(instance, [triangles, quadrics])| {
                let transform = self.accel.instance_transform(instance).to_world();
                let bits = transform.to_cols_array().map(f32::to_bits);
                let position = self.accel.instance_position(instance);
                let first_light = self.emitters.instance(position);
                let first_light = first_light.map(|light| light.0);
                ([triangles.start, quadrics.start], bits, first_light)
            })
            .collect();
        instances.sort_unstable();
        let geometry = (&self.meshes, &self.quadrics, self.accel.world(), instances);
        [
            ("geometry", content_digest(&geometry)),
            ("materials", content_digest(&self.materials)),
            ("images", content_digest(&self.images)),
        ]
    }
}
