//! Rows of bits.

/// A table of bits, as many words to each row.
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

    /// Every bit of one row of `columns` set.
    pub(super) fn full(columns: usize) -> Self {
        let mut bits = Self::new(1, columns);
        (0..columns).for_each(|column| bits.set(0, column));
        bits
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
}
