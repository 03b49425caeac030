use lights::glam::Vec3;

/// Packets of the image viewer tev: their length in bytes, the length included, then a byte that
/// says what is asked for; all numbers are little-endian, all texts end with a zero byte.
///
/// # Source
/// `[Muller2017]`, the section on network connections of its page.
struct Packet {
    bytes: Vec<u8>,
}

/// Make an empty image.
const CREATE_IMAGE: u8 = 4;

/// Set pixels of an image, channels anywhere in the data.
const UPDATE_IMAGE: u8 = 6;

const CHANNELS: [&str; 3] = ["R", "G", "B"];

impl Packet {
    /// `kind`, and whether the viewer shows the image at once.
    fn new(kind: u8, shows: u8, image: &str) -> Self {
        let mut packet = Self {
            // The length comes last.
            bytes: vec![0, 0, 0, 0, kind, shows],
        };
        packet.text(image);
        packet
    }

    fn text(&mut self, text: &str) {
        self.bytes.extend(text.bytes().filter(|&byte| byte != 0));
        self.bytes.push(0);
    }

    fn integer(&mut self, x: u32) {
        self.bytes.extend(x.to_le_bytes());
    }

    fn channels(&mut self) {
        self.integer(3);
        CHANNELS.iter().for_each(|name| self.text(name));
    }

    fn into_bytes(mut self) -> Vec<u8> {
        let length = u32::try_from(self.bytes.len()).unwrap_or(u32::MAX);
        self.bytes[..4].copy_from_slice(&length.to_le_bytes());
        self.bytes
    }
}

/// Asks for an image of three channels, which is shown at once. One of the same name is replaced.
pub(super) fn create_image(name: &str, width: u32, height: u32) -> Vec<u8> {
    let mut packet = Packet::new(CREATE_IMAGE, 1, name);
    packet.integer(width);
    packet.integer(height);
    packet.channels();
    packet.into_bytes()
}

/// Sets the rows of an image from `y` on; `pixels` are whole rows of `width`.
pub(super) fn update_rows(name: &str, y: u32, width: u32, pixels: &[Vec3]) -> Vec<u8> {
    let mut packet = Packet::new(UPDATE_IMAGE, 0, name);
    packet.channels();
    let rows = u32::try_from(pixels.len() / width.max(1) as usize).unwrap_or(u32::MAX);
    [0, y, width, rows]
        .into_iter()
        .for_each(|x| packet.integer(x));
    // Where each channel begins among the numbers, and how far its next one is.
    for number in [0_u64, 1, 2, 3, 3, 3] {
        packet.bytes.extend(number.to_le_bytes());
    }
    let numbers = pixels.iter().flat_map(Vec3::to_array);
    packet.bytes.extend(numbers.flat_map(f32::to_le_bytes));
    packet.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hex(bytes: &[u8]) -> String {
        bytes.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// The bytes are those of the PyPI package `tevclient` 1.0.4 for the same image.
    #[test]
    fn packets_are_those_of_the_package() {
        assert_eq!(
            hex(&create_image("a.exr", 2, 3)),
            "1e0000000401612e65787200020000000300000003000000520047004200",
            "create"
        );
        let pixels = [Vec3::new(0.0, 0.5, 1.0), Vec3::new(2.0, -1.0, 0.25)];
        assert_eq!(
            hex(&update_rows("a.exr", 1, 2, &pixels)),
            concat!(
                "6e0000000600612e657872000300000052004700420000000000010000000200",
                "0000010000000000000000000000010000000000000002000000000000000300",
                "00000000000003000000000000000300000000000000000000000000003f0000",
                "803f00000040000080bf0000803e"
            ),
            "update"
        );
    }

    #[test]
    fn names_end_where_they_end() {
        let packet = create_image("a\0b", 1, 1);
        assert_eq!(&packet[6..9], b"ab\0", "one zero byte");
        assert_eq!(packet[0] as usize, packet.len(), "its length");
    }
}
