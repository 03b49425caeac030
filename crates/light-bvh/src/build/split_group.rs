/// Lights on their way into a tree, at least one.
pub(crate) trait SplitGroup: Sized + Send {
    /// How many they are.
    fn lights(&self) -> usize;

    /// Whether they can be split.
    fn is_divisible(&self) -> bool;

    /// About the longest side of the box of their positions.
    fn size(&self) -> f32;

    /// Of all of them together.
    fn power(&self) -> f32;

    /// What splitting them may gain.
    fn cost(&self) -> f32;

    /// Two groups that cost less together; neither is empty.
    fn split(self) -> (Self, Self);

    /// Two groups of the same number of lights, but for one.
    fn halve(self) -> (Self, Self);

    /// Calls `each` with every light.
    fn each_light(&self, each: impl FnMut(u32));
}
