/// Hands the methods of [`Light`](crate::Light) to the light that `$each` finds in `self`.
macro_rules! forward_light {
    ($each:ident $(, #[$inline:meta])?) => {
        $(#[$inline])?
        fn light_type(&self) -> LightType {
            $each!(self, light => light.light_type())
        }

        fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
            $each!(self, light => light.phi(wavelengths))
        }

        $(#[$inline])?
        fn sample_li(
            &self,
            ctx: &LightSampleContext,
            u: Vec2,
            wavelengths: &C::Wavelengths,
            coverage: PdfCoverage,
        ) -> Option<LightLiSample<C::Radiance>> {
            $each!(self, light => light.sample_li(ctx, u, wavelengths, coverage))
        }

        $(#[$inline])?
        fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, coverage: PdfCoverage) -> f32 {
            $each!(self, light => light.pdf_li(ctx, wi, coverage))
        }

        $(#[$inline])?
        fn sample_le(
            &self,
            u1: Vec2,
            u2: Vec2,
            wavelengths: &C::Wavelengths,
        ) -> Option<LightLeSample<C::Radiance>> {
            $each!(self, light => light.sample_le(u1, u2, wavelengths))
        }

        $(#[$inline])?
        fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
            $each!(self, light => light.pdf_le(ray))
        }

        fn extent(&self) -> LightExtent {
            $each!(self, light => light.extent())
        }

        fn media(&self) -> MediumInterface {
            $each!(self, light => light.media())
        }
    };
}

pub(crate) use forward_light;
