using System;
using System.Collections;
using System.Collections.Generic;

namespace UnityEngine.UIElements
{
    public enum AlternatingRowBackground
    {
        None,
        ContentOnly,
        All,
    }

    public enum ColumnSortingMode
    {
        None,
        Default,
        Custom,
    }

    public enum SortDirection
    {
        Ascending,
        Descending,
    }

    public struct Length
    {
        public float value { get; set; }
        public static implicit operator Length(float value) => new Length { value = value };
    }

    public class SortColumnDescription
    {
        public string columnName { get; set; }
        public SortDirection direction { get; set; }
    }

    public class Column
    {
        public string name { get; set; }
        public string title { get; set; }
        public Length width { get; set; }
        public bool stretchable { get; set; }
        public bool sortable { get; set; } = true;
        public Func<VisualElement> makeCell { get; set; }
        public Action<VisualElement, int> bindCell { get; set; }
    }

    public class Columns
    {
        internal readonly List<Column> Items = new List<Column>();
        public void Add(Column item) => Items.Add(item);
    }

    /// A table. Tests simulate clicks on a header or a row with `ClickHeader` and `ClickRow`.
    public class MultiColumnListView : VisualElement
    {
        readonly List<SortColumnDescription> sorted = new List<SortColumnDescription>();
        int[] selected = new int[0];

        public Columns columns { get; } = new Columns();
        public ColumnSortingMode sortingMode { get; set; }
        public IEnumerable<SortColumnDescription> sortedColumns => sorted;
        public IList itemsSource { get; set; }
        public float fixedItemHeight { get; set; } = 22;
        public AlternatingRowBackground showAlternatingRowBackgrounds { get; set; }
        public int selectedIndex => selected.Length > 0 ? selected[0] : -1;
        public event Action columnSortingChanged;
        public event Action<IEnumerable<object>> selectionChanged;
        public void RefreshItems() => RowCount = itemsSource.Count;

        public void SetSelectionWithoutNotify(IEnumerable<int> indices) => selected = new List<int>(indices).ToArray();

        /// Number of rows at the last refresh. Changes of the list become visible at the next refresh.
        internal int RowCount { get; private set; }

        public void ClickHeader(string column, SortDirection direction)
        {
            sorted.Clear();
            sorted.Add(new SortColumnDescription { columnName = column, direction = direction });
            columnSortingChanged?.Invoke();
        }

        public void ClickRow(int index)
        {
            selected = new[] { index };
            selectionChanged?.Invoke(new[] { itemsSource[index] });
        }

        /// Returns the texts of the first rows that fit into `height`. Only the cells of these rows are bound.
        public IEnumerable<string> VisibleRows(float height)
        {
            for (var row = 0; row < RowCount && row * fixedItemHeight < height; row++)
            {
                var cells = new List<string>();
                foreach (var column in columns.Items)
                {
                    var cell = column.makeCell();
                    column.bindCell(cell, row);
                    cells.Add(((Label)cell).text);
                }
                yield return string.Join(" | ", cells);
            }
        }
    }
}
