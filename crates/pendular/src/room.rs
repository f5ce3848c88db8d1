/// Makes room for `more` in a list that gets most of its size at once and grows little by little
/// from then on: room for twice as many, as lists usually take, would never be filled.
pub(crate) fn make_room<T>(list: &mut Vec<T>, more: usize) {
    if list.capacity() - list.len() < more {
        list.reserve_exact(more.max(list.len() / 16));
    }
}
