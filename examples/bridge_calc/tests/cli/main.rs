//! The program from outside: CSV in, CSV out.

mod bad_input;
mod exact;
mod formulas;
mod other;
mod run;
