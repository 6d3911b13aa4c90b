//! A bit matrix.

/// A bit matrix with a whole number of words per row.
#[derive(Debug, Clone)]
pub(super) struct Bits {
    /// Words of one row, at least one.
    words: usize,
    data: Vec<u64>,
}

impl Bits {
    /// All bits clear.
    pub(super) fn new(rows: usize, columns: usize) -> Self {
        let words = columns.div_ceil(64).max(1);
        Self { words, data: vec![0; rows * words] }
    }

    /// Every bit set.
    pub(super) fn full(rows: usize, columns: usize) -> Self {
        let mut bits = Self::new(rows, columns);
        bits.data.fill(u64::MAX);
        let last = columns - columns.saturating_sub(1) / 64 * 64;
        let rest = if last == 64 { u64::MAX } else { (1 << last) - 1 };
        let words = bits.words;
        bits.data.iter_mut().skip(words - 1).step_by(words).for_each(|word| *word = rest);
        bits
    }

    /// The words of all rows together.
    pub(super) fn words(&self) -> usize {
        self.data.len()
    }

    pub(super) fn row(&self, row: usize) -> &[u64] {
        &self.data[row * self.words..(row + 1) * self.words]
    }

    pub(super) fn set(&mut self, row: usize, column: usize) {
        self.data[row * self.words + column / 64] |= 1 << (column % 64);
    }

    pub(super) fn clear(&mut self, row: usize, column: usize) {
        self.data[row * self.words + column / 64] &= !(1 << (column % 64));
    }

    pub(super) fn clear_row(&mut self, row: usize) {
        self.data[row * self.words..(row + 1) * self.words].fill(0);
    }

    pub(super) fn has(&self, row: usize, column: usize) -> bool {
        self.data[row * self.words + column / 64] >> (column % 64) & 1 == 1
    }

    pub(super) fn count(&self, row: usize) -> usize {
        self.row(row).iter().map(|word| word.count_ones() as usize).sum()
    }

    /// The first set bit of a row at `from` or after it. For loops that change the row as they go.
    pub(super) fn next(&self, row: usize, from: usize) -> Option<usize> {
        let words = self.row(row);
        let mut at = from / 64;
        let mut word = words.get(at)? & (u64::MAX << (from % 64));
        while word == 0 {
            at += 1;
            word = *words.get(at)?;
        }
        Some(at * 64 + word.trailing_zeros() as usize)
    }

    /// The set bits of a row.
    pub(super) fn ones(&self, row: usize) -> impl Iterator<Item = usize> + '_ {
        self.row(row).iter().enumerate().flat_map(|(at, &word)| {
            core::iter::successors((word != 0).then_some(word), |rest| {
                let less = rest & (rest - 1);
                (less != 0).then_some(less)
            })
            .map(move |rest| at * 64 + rest.trailing_zeros() as usize)
        })
    }

    /// Adds a row's bits to `into`, a row of the same width.
    pub(super) fn unite(&self, row: usize, into: &mut [u64]) {
        into.iter_mut().zip(self.row(row)).for_each(|(word, other)| *word |= other);
    }

    /// Replaces a row. True if that changes it.
    pub(super) fn replace(&mut self, row: usize, by: &[u64]) -> bool {
        let row = &mut self.data[row * self.words..(row + 1) * self.words];
        let changed = row != by;
        row.copy_from_slice(by);
        changed
    }
}
