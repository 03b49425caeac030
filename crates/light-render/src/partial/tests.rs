use super::*;

fn identity(seed: &str) -> PictureIdentity {
    PictureIdentity::new([("seed", seed.to_owned())])
}

fn part(samples: Range<u32>, seed: &str, scale: f32) -> PartialPicture {
    let mut film = Film::new(2, 1);
    for sample in samples.clone() {
        let x = scale / (sample as f32 + 3.0);
        let row = &mut film.expose(1)[0];
        for pixel in 0..2 {
            row.add(pixel, Vec3::new(x, x * 1e4, x * 1e-9));
        }
    }
    PartialPicture {
        film,
        samples,
        identity: identity(seed),
    }
}

fn file() -> &'static Path {
    Path::new("part.exr")
}

#[test]
fn parts_add_up_to_the_whole_through_files() {
    // The largest sums need all words.
    for scale in [1.0, 1e4, 1e12, -1.0] {
        let back = |part: &PartialPicture| {
            let bytes = part.to_bytes(file()).expect("bytes");
            PartialPicture::parse(file(), &bytes).expect("a part")
        };
        let parts = [3..7, 0..3, 7..20].map(|range| back(&part(range, "a", scale)));
        let whole = part(0..20, "a", scale).film;
        assert_eq!(PartialPicture::merge(parts), Ok(whole), "to the last bit");
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let merge = |parts: &[PartialPicture]| PartialPicture::merge(parts.to_vec()).err();
    let a = part(0..4, "a", 1.0);
    let difference = "seed b, expected a".into();
    let other = Some(PartialPictureError::OtherPicture { difference });
    assert_eq!(
        merge(&[a.clone(), part(4..5, "b", 1.0)]),
        other,
        "another picture"
    );
    let samples = 3..5;
    let overlap = Some(PartialPictureError::Overlap { samples });
    assert_eq!(
        merge(&[a.clone(), part(3..5, "a", 1.0)]),
        overlap,
        "sample 3 twice"
    );
    assert_eq!(merge(&[]), Some(PartialPictureError::Nothing), "nothing");
    let mut file = a.to_file();
    file.notes.clear();
    let bytes = file.into_bytes(Path::new("a.exr")).expect("bytes");
    let error = PartialPicture::parse(Path::new("a.exr"), &bytes).expect_err("no part");
    assert!(error.to_string().contains("--samples"), "{error}");
}

#[test]
fn joined_parts_are_a_part() {
    let parts = || [3..7, 0..3, 7..20].map(|range| part(range, "a", 1.0));
    let joined = PartialPicture::join(parts());
    assert_eq!(joined, Ok(part(0..20, "a", 1.0)), "as if rendered at once");
    let [a, b, c] = parts();
    let samples = 3..7;
    let gap = Err(PartialPictureError::Gap { samples });
    assert_eq!(PartialPicture::join([c, b]), gap, "a part is missing");
    let samples = 3..7;
    let overlap = Err(PartialPictureError::Overlap { samples });
    assert_eq!(PartialPicture::join([a.clone(), a]), overlap, "one twice");
}

#[test]
fn every_flipped_bit_is_found() {
    let bytes = part(0..3, "a", 1.0).to_bytes(file()).expect("bytes");
    for bit in 0..8 * bytes.len() {
        let mut broken = bytes.clone();
        broken[bit / 8] ^= 1 << (bit % 8);
        assert!(PartialPicture::parse(file(), &broken).is_err(), "bit {bit}");
    }
    for length in 0..bytes.len() {
        let cut = &bytes[..length];
        assert!(
            PartialPicture::parse(file(), cut).is_err(),
            "{length} bytes"
        );
    }
    assert!(PartialPicture::parse(file(), &bytes).is_ok(), "as it was");
}
