//! What a program consists of.

/// A statement and its line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Statement {
    /// The line, from 1.
    pub(super) line: usize,
    /// What it says.
    pub(super) kind: StatementKind,
}

/// What a statement says.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum StatementKind {
    /// `def NAME(PARAMETERS): … end`
    Function(Function),
    /// `NAME = VALUE`, with or without `local` and `global`.
    Assignment(Scope, String, Expression),
    /// A call.
    Call(Call),
    /// `if … elif … else … end`: conditions with their lines, and what follows them.
    If(Vec<Branch>),
    /// `halt`
    Halt,
}

/// A function.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Function {
    pub(super) name: String,
    pub(super) parameters: Vec<String>,
    pub(super) body: Vec<Statement>,
}

/// A condition, none for `else`, and what is done where it holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Branch {
    pub(super) line: usize,
    pub(super) condition: Option<Expression>,
    pub(super) body: Vec<Statement>,
}

/// Where a variable is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// Not said.
    Unsaid,
    /// `local`
    Local,
    /// `global`
    Global,
}

/// A call.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Call {
    pub(super) name: String,
    /// Arguments in order, each with its name where it has one.
    pub(super) arguments: Vec<(Option<String>, Expression)>,
}

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Expression {
    Number(f64),
    Bool(bool),
    Text(String),
    Name(String),
    /// `[…]`
    List(Vec<Expression>),
    /// `p[…]`
    Pose(Vec<Expression>),
    /// `VALUE[INDEX]`
    Index(Box<Expression>, Box<Expression>),
    Negative(Box<Expression>),
    Not(Box<Expression>),
    Binary(Operator, Box<[Expression; 2]>),
    Call(Call),
}

/// An operator between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Or,
    And,
    Equal,
    Different,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Plus,
    Minus,
    Times,
    Over,
}
