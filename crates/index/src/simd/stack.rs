//! The stack of a walk: children still to be entered, with the distances at which the ray does.

use super::{LANES, Lanes};
use crate::bsp::params::MAX_DEPTH;
use std::marker::PhantomData;
use std::mem::MaybeUninit;

/// Stands for a child where there are no more.
pub(crate) const END: u32 = u32::MAX;

/// Places of a stack: a node leaves at most seven children behind; rows are written whole.
const PLACES: usize = ((LANES - 1) * (MAX_DEPTH as usize + 1) + 3 * LANES).next_multiple_of(LANES);

/// Room for a stack: places are written before they are read, because clearing them would cost more than a short walk.
pub(crate) struct StackRoom(MaybeUninit<Places>);

#[repr(C, align(32))]
struct Places {
    children: [u32; PLACES],
    nears: [f32; PLACES],
}

impl StackRoom {
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self(MaybeUninit::uninit())
    }
}

/// What a walk does with its stack.
pub(crate) trait Pending<'r> {
    /// An empty stack.
    fn new(room: &'r mut StackRoom) -> Self;

    /// Forgets all children.
    fn clear(&mut self);

    /// Takes the child on top; [`END`] where there is none.
    fn pop(&mut self) -> u32;

    /// Forgets all children that are entered beyond `limit`.
    fn forget_beyond(&mut self, limit: f32);
}

/// A stack in its room. With `DOWN` it grows downward, so that the first lane of a row that is written is the one on top;
/// otherwise upward, so that rows can be written whole.
pub(crate) struct Stack<'r, const DOWN: bool> {
    children: *mut u32,
    nears: *mut f32,
    /// The place on top; all from there to the bottom are written.
    top: usize,
    room: PhantomData<&'r mut StackRoom>,
}

impl<'r, const DOWN: bool> Stack<'r, DOWN> {
    /// An empty stack, nothing of which is written.
    #[inline(always)]
    fn at(room: &'r mut StackRoom) -> Self {
        let places = room.0.as_mut_ptr();
        // SAFETY: the places are there, if not yet written; these are their addresses.
        let (children, nears) = unsafe { (&raw mut (*places).children, &raw mut (*places).nears) };
        Self { children: children.cast(), nears: nears.cast(), top: Self::BOTTOM, room: PhantomData }
    }

    /// The top of an empty stack.
    const BOTTOM: usize = if DOWN { PLACES - LANES } else { LANES };

    /// Where the row of the lowest places starts.
    const LOWEST_ROW: usize = if DOWN { Self::BOTTOM - LANES } else { Self::BOTTOM + 1 };

    #[inline(always)]
    fn write(&mut self, place: usize, child: u32, near: f32) {
        debug_assert!(place < PLACES);
        // SAFETY: only places of the stack are written.
        unsafe {
            self.children.add(place).write(child);
            self.nears.add(place).write(near);
        }
    }

    /// The place above another.
    #[inline(always)]
    fn above(place: usize) -> usize {
        if DOWN { place - 1 } else { place + 1 }
    }

    /// Puts a child on top.
    #[inline(always)]
    pub(super) fn push(&mut self, child: u32, near: f32) {
        self.check();
        self.grow(1);
        self.write(self.top, child, near);
    }

    /// # Panics
    /// When there is no room for a row on top: the tree is deeper than any that is built.
    #[inline(always)]
    fn check(&self) {
        let is_room = if DOWN { self.top >= LANES } else { self.top < PLACES - 2 * LANES };
        assert!(is_room, "a walk is deeper than its stack");
    }

    /// Where a row of `count` children is to be written, downward with the top first, upward with the top last.
    #[inline(always)]
    pub(super) fn row(&mut self, count: usize) -> (*mut u32, *mut f32) {
        self.check();
        let start = if DOWN { self.top - count } else { self.top + 1 };
        // SAFETY: there is room for a row.
        unsafe { (self.children.add(start), self.nears.add(start)) }
    }

    /// Where the lowest row starts; all of it is written, if only with nothing.
    #[inline(always)]
    pub(super) fn lowest_row(&self) -> (*const u32, *const f32) {
        // SAFETY: the row is inside.
        unsafe { (self.children.add(Self::LOWEST_ROW), self.nears.add(Self::LOWEST_ROW)) }
    }

    /// How many children there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        if DOWN { Self::BOTTOM - self.top } else { self.top - Self::BOTTOM }
    }

    /// Makes the `count` children that were written next to the top part of the stack.
    #[inline(always)]
    pub(super) fn grow(&mut self, count: usize) {
        self.top = if DOWN { self.top - count } else { self.top + count };
    }

    /// Takes the child on top away.
    #[inline(always)]
    pub(super) fn take(&mut self) -> u32 {
        // SAFETY: the place is one of those that are written.
        let child = unsafe { self.children.add(self.top).read() };
        self.top = if DOWN { self.top + 1 } else { self.top - 1 };
        child
    }
}

impl<'r, const DOWN: bool> Pending<'r> for Stack<'r, DOWN> {
    #[inline(always)]
    fn new(room: &'r mut StackRoom) -> Self {
        let mut stack = Self::at(room);
        for place in Self::LOWEST_ROW..Self::LOWEST_ROW + LANES {
            stack.write(place, END, f32::INFINITY);
        }
        stack
    }

    #[inline(always)]
    fn clear(&mut self) {
        self.top = Self::BOTTOM;
    }

    #[inline(always)]
    fn pop(&mut self) -> u32 {
        if self.top == Self::BOTTOM {
            return END;
        }
        self.take()
    }

    #[inline(always)]
    fn forget_beyond(&mut self, limit: f32) {
        // From the bottom up, each child is moved over those that were forgotten.
        let (mut from, mut to) = (Self::BOTTOM, Self::BOTTOM);
        while from != self.top {
            from = Self::above(from);
            // SAFETY: the place is one of those that are written.
            let (child, near) = unsafe { (self.children.add(from).read(), self.nears.add(from).read()) };
            self.write(Self::above(to), child, near);
            to = if near <= limit { Self::above(to) } else { to };
        }
        self.top = to;
    }
}

/// The stacks of `N` rays, all upward, in their rooms.
pub(crate) struct Stacks<'r, const N: usize> {
    rooms: &'r mut [StackRoom; N],
    tops: [u32; N],
}

impl<'r, const N: usize> Stacks<'r, N> {
    /// Empty stacks, with [`END`] below each.
    #[inline(always)]
    pub(crate) fn new(rooms: &'r mut [StackRoom; N]) -> Self {
        let bottom = Stack::<false>::BOTTOM;
        for room in rooms.iter_mut() {
            Stack::<false>::new(room).write(bottom, END, f32::NEG_INFINITY);
        }
        Self { rooms, tops: [bottom as u32; N] }
    }

    /// Forgets all children of all.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.tops = [Stack::<false>::BOTTOM as u32; N];
    }

    /// Takes the child on top of the stack of a ray; [`END`] where there is none, and nothing may be taken any more.
    #[inline(always)]
    pub(crate) fn take(&mut self, ray: usize) -> u32 {
        let mut stack = self.stack(ray);
        let child = stack.take();
        self.tops[ray] = stack.top as u32;
        child
    }

    /// [`Lanes::push_met`] on the stack of a ray.
    #[inline(always)]
    pub(crate) fn push_met<L: Lanes>(
        &mut self,
        lanes: L,
        ray: usize,
        (near, far): (L::F, L::F),
        children: &[u32; LANES],
        order: u32,
        forgets: bool,
    ) {
        let mut stack = self.stack(ray);
        lanes.push_met(&mut stack, near, far, children, order, forgets);
        self.tops[ray] = stack.top as u32;
    }

    /// [`Lanes::forget_of_many`] on the stack of a ray.
    #[inline(always)]
    pub(crate) fn forget_beyond(&mut self, lanes: impl Lanes, ray: usize, limit: f32) {
        let mut stack = self.stack(ray);
        lanes.forget_of_many(&mut stack, limit);
        self.tops[ray] = stack.top as u32;
    }

    /// The stack of a ray as it was left.
    #[inline(always)]
    fn stack(&mut self, ray: usize) -> Stack<'_, false> {
        let top = self.tops[ray] as usize;
        Stack { top, ..Stack::at(&mut self.rooms[ray]) }
    }
}
