/// Lines of these many texels may be packed by component.
const BY_COMPONENT: core::ops::RangeInclusive<usize> = 8..=0x7fff;

/// Three mantissas and their exponent.
pub(super) type Rgbe = [u8; 4];

/// Unpacks one line after another.
#[derive(Debug)]
pub(super) struct Scanlines<'a> {
    bytes: &'a [u8],
    at: usize,
    line: Vec<Rgbe>,
}

/// What is wrong with a scanline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// The byte, counted from the first line.
    pub(super) byte: usize,
    pub(super) expected: &'static str,
}

impl<'a> Scanlines<'a> {
    pub(super) fn new(bytes: &'a [u8], length: usize) -> Self {
        Self {
            bytes,
            at: 0,
            line: vec![[0; 4]; length],
        }
    }

    /// The next line.
    pub(super) fn next(&mut self) -> Result<&[Rgbe], Fault> {
        let length = self.line.len();
        let start = self.bytes.get(self.at..self.at + 4);
        match *start.unwrap_or_default() {
            [2, 2, high, low] if BY_COMPONENT.contains(&length) && high < 128 => {
                if usize::from(high) << 8 | usize::from(low) != length {
                    return Err(self.fault("the length that the header says"));
                }
                self.at += 4;
                (0..4).try_for_each(|component| self.component(component))?;
            }
            _ => self.texels()?,
        }
        Ok(&self.line)
    }

    /// One component of all texels: runs of equal bytes, and bytes as they are.
    fn component(&mut self, component: usize) -> Result<(), Fault> {
        let mut place = 0;
        while place < self.line.len() {
            let [count] = self.take()?;
            let (is_run, count) = match count {
                129.. => (true, usize::from(count - 128)),
                _ => (false, usize::from(count)),
            };
            if count > self.line.len() - place {
                self.at -= 1;
                return Err(self.fault("a run that ends with the line"));
            }
            let mut value = 0;
            for number in 0..count {
                if number == 0 || !is_run {
                    [value] = self.take()?;
                }
                self.line[place + number][component] = value;
            }
            place += count;
        }
        Ok(())
    }

    /// Whole texels, and runs of them: those of mantissas 1 say how often the last one is repeated,
    /// each next of them 256 times as often.
    fn texels(&mut self) -> Result<(), Fault> {
        let (mut place, mut unit) = (0, 1usize);
        while place < self.line.len() {
            match self.take()? {
                [1, 1, 1, count] => {
                    let run = usize::from(count).saturating_mul(unit);
                    if place == 0 || run > self.line.len() - place {
                        self.at -= 4;
                        return Err(self.fault("a run behind a texel that ends with the line"));
                    }
                    let last = self.line[place - 1];
                    self.line[place..place + run].fill(last);
                    place += run;
                    unit = unit.saturating_mul(256);
                }
                texel => {
                    self.line[place] = texel;
                    place += 1;
                    unit = 1;
                }
            }
        }
        Ok(())
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let taken = self.bytes[self.at..].first_chunk();
        let taken =
            taken.ok_or_else(|| self.fault("more of the file: the end of the file is missing"))?;
        self.at += N;
        Ok(*taken)
    }

    const fn fault(&self, expected: &'static str) -> Fault {
        Fault {
            byte: self.at,
            expected,
        }
    }
}
