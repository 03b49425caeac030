use crate::glam::{Vec2, Vec3};
use crate::{MaterialId, Mesh};

impl Mesh {
    /// A grid of vertices over the unit square of (u, v); `point` gives position and normal, u runs
    /// counter-clockwise around v seen from the front.
    pub(crate) fn grid(
        [columns, rows]: [u16; 2],
        point: impl Fn(f32, f32) -> (Vec3, Vec3),
    ) -> Self {
        let mut mesh = Self::new("", MaterialId(0));
        let (mut normals, mut uvs) = (Vec::new(), Vec::new());
        for row in 0..=rows {
            for column in 0..=columns {
                let uv = Vec2::new(
                    f32::from(column) / f32::from(columns),
                    f32::from(row) / f32::from(rows),
                );
                let (position, normal) = point(uv.x, uv.y);
                mesh.positions.push(position);
                normals.push(normal);
                uvs.push(uv);
            }
        }
        let (across, up) = (u32::from(columns), u32::from(rows));
        for row in 0..up {
            for column in 0..across {
                let a = row * (across + 1) + column;
                let b = a + across + 1;
                mesh.indices.push([a, a + 1, b + 1]);
                mesh.indices.push([a, b + 1, b]);
            }
        }
        (mesh.normals, mesh.uvs) = (Some(normals), Some(uvs));
        mesh
    }
}
