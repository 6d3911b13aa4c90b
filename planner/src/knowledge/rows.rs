//! Many short lists in one (compressed sparse rows).

/// Lists numbered from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rows<T> {
    /// Per list the start of its entries; at the end the number of all entries.
    first: Vec<u32>,
    entries: Vec<T>,
}

impl<T: Copy> Rows<T> {
    /// `count` lists, from pairs of a list's number and an entry. Entries keep their order.
    pub fn from_pairs(count: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut first = vec![0_u32; count + 1];
        pairs.clone().for_each(|(list, _)| first[list as usize + 1] += 1);
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let Some((_, any)) = pairs.clone().next() else { return Self { first, entries: Vec::new() } };
        let mut next = first.clone();
        let mut entries = vec![any; first[count] as usize];
        for (list, entry) in pairs {
            let slot = &mut next[list as usize];
            entries[*slot as usize] = entry;
            *slot += 1;
        }
        Self { first, entries }
    }

    /// Adds a list at the end.
    pub fn push(&mut self, list: &[T]) {
        self.entries.extend_from_slice(list);
        let end = u32::try_from(self.entries.len()).expect("the limits of a scene keep a base below 2^32 entries");
        self.first.push(end);
    }

    /// Makes room for so many more lists and entries.
    pub fn reserve(&mut self, lists: usize, entries: usize) {
        self.first.reserve_exact(lists);
        self.entries.reserve_exact(entries);
    }

    /// One list.
    pub fn get(&self, list: usize) -> &[T] {
        &self.entries[self.first[list] as usize..self.first[list + 1] as usize]
    }

    /// The number of lists.
    pub fn lists(&self) -> usize {
        self.first.len() - 1
    }

    /// The number of entries of all lists together.
    pub fn entries(&self) -> usize {
        self.entries.len()
    }
}

/// No lists.
impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self { first: vec![0], entries: Vec::new() }
    }
}
