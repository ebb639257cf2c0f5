//! Every program that any scene can link: that it is valid, that its records are the host's, and
//! that it holds nothing that its scene does not need.

mod layout;
mod lean;
mod programs;
